#include "engine/render/software/SoftwareBackground.h"

#include "engine/math/LatLong.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/software/PaintTexels.h"
#include "engine/render/software/ShadeTexels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace shoal::render {

namespace {

bool canSample(const EyePicture& picture) {
    return canSampleFrames() && showsFrameAsCoded(picture.environment, picture.exposure) &&
           picture.canvas.samples() == 1;
}

// Returns whether the layer shows anything in a tile of the frame's texels, or a little beside it.
bool showsAnything(LayerPass& layer, const TexelPaint& paint, const FrameTiles& tiles,
                   const glm::ivec2& tile) {
    constexpr float kMargin = 3; // pixels: the filter, smoothed outlines and shared colours reach so far
    glm::vec2 low(INFINITY), high(-INFINITY);
    for (int k = 0; k < 4; ++k) {
        const glm::ivec2 corner = tiles.lowOf(tile + glm::ivec2(k & 1, k >> 1));
        const glm::vec3 ray =
            paint.eyeFromEnv * directionFromLatLong(glm::vec2(corner) / glm::vec2(tiles.frameSize()));
        if (ray.z > -0.05f) return true; // too far aside to be a quadrangle in the picture
        const glm::vec2 place = (glm::vec2(ray) / -ray.z - paint.rayShift) / paint.rayScale;
        const glm::vec2 pixel = (0.5f * place + 0.5f) * glm::vec2(paint.layerSize);
        low = glm::min(low, pixel), high = glm::max(high, pixel);
    }
    const glm::vec2 size(paint.layerSize);
    return layer.coverage().any(glm::ivec2(glm::floor(glm::clamp(low - kMargin, glm::vec2(-1), size))),
                                glm::ivec2(glm::floor(glm::clamp(high + kMargin, glm::vec2(-1), size))));
}

void copyTexels(const DisplayFrame& frame, const glm::ivec2& low, const glm::ivec2& high, uint32_t* out,
                ptrdiff_t outStride) {
    const auto* from = reinterpret_cast<const uint32_t*>(frame.pixels);
    for (int y = low.y; y < high.y; ++y)
        std::copy_n(from + ptrdiff_t{y} * frame.rowPixels + low.x, high.x - low.x,
                    out + y * outStride + low.x);
}

} // namespace

SoftwareBackground::SoftwareBackground()
    : threadPool_(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1) {}

void SoftwareBackground::SampleRow::operator()(int row) const {
    const size_t first = pass->grid_.rowBegin(row), cells = pass->grid_.rowBegin(row + 1) - first;
    for (const State& state : std::span(pass->states_).subspan(first, cells))
        if (state.due)
            sampleCell(state.painted ? painted : frame, state.sampled, pass->picture_.data(),
                       pass->shown_.size.x);
}

void SoftwareBackground::classify(const EyePicture& picture) {
    grid_.make(picture.view, shown_.envFromRay, shown_.size, picture.filmParallax());
    const glm::vec2 texels(shown_.frame.width, shown_.frame.height);
    states_.clear();
    for (const BackgroundCell& cell : grid_.all()) {
        const glm::vec2 right = cell.right * texels / static_cast<float>(cell.high.x - cell.low.x);
        const glm::vec2 up = cell.up * texels / static_cast<float>(cell.high.y - cell.low.y);
        const SampledCell sampled{cell.low, cell.high, cell.first * texels + 0.5f * (right + up) - 0.5f,
                                  right, up};
        states_.push_back({sampled, !cell.polar && isWithin(shown_.frame, sampled)});
    }
    picture_.resize(static_cast<size_t>(shown_.size.x) * static_cast<size_t>(shown_.size.y));
}

void SoftwareBackground::prepare(const EyePicture& picture, const FrameTiles* tiles) {
    if (!canSample(picture)) return;
    if (started_) threadPool_.finish(); // stops the sampling of a picture that was never drawn
    const Shown shown{picture.environment.displayFrame(),
                      picture.environment.frameNumber(),
                      picture.view.halfExtent(),
                      picture.view.shift,
                      picture.envFromEye(),
                      picture.size(),
                      picture.filmParallax().eyeInFilm};
    const bool same = !states_.empty() && shown == shown_;
    shown_ = shown;
    if (!same) classify(picture);
    const FilmShadows* shadows = picture.seenShadows();
    const auto were = std::exchange(shadows_, shadows ? shadows->version() : FilmShadows::Version());
    for (size_t k = 0; k < states_.size(); ++k) {
        const BackgroundCell& cell = grid_.all()[k];
        State& state = states_[k];
        if (state.shown == Content::Shaded && were != shadows_) state.shown = Content::Unknown;
        state.shaded = shadows && shadows->tiles().isChosen(cell.mapLow(), cell.mapHigh());
        state.painted = state.shaded || (tiles && tiles->isChosen(cell.mapLow(), cell.mapHigh()));
        state.due = state.here && !state.painted && state.shown != Content::Frame;
        if (state.due) state.shown = Content::Frame;
    }
    sampleRow_ = {this, shown_.frame, {}};
    threadPool_.start(grid_.rows(), sampleRow_);
    started_ = true;
}

Status SoftwareBackground::draw(const EyePicture& picture, const TexelLayer* layer) {
    if (!canSample(picture)) return BackgroundPass::draw(picture, layer);
    if (!started_) prepare(picture, layer ? &layer->tiles : nullptr);
    threadPool_.finish();
    started_ = false;
    drawn_.clear();
    wanted_.assign(FrameTiles::kAll, false);
    const FilmShadows* shadows = picture.seenShadows();
    const TexelPaint paint = layer ? paintOf(picture, *layer) : TexelPaint();
    if (layer) findCovered(*layer, paint);
    for (size_t k = 0; k < states_.size(); ++k) {
        const BackgroundCell& cell = grid_.all()[k];
        State& state = states_[k];
        if (!state.here)
            drawn_.push_back({&cell, layer && layer->tiles.isChosen(cell.mapLow(), cell.mapHigh())});
        state.due = state.here && state.painted;
        if (!state.due) continue;
        const bool covered = layer && covered_.isChosen(cell.mapLow(), cell.mapHigh());
        const Content content = covered ? Content::Objects : state.shaded ? Content::Shaded : Content::Frame;
        state.due = covered || content != state.shown;
        state.shown = content;
        state.painted = state.shaded || covered;
        if (state.due && state.painted) want(layer ? layer->tiles : shadows->tiles(), cell);
    }
    if (std::ranges::find(wanted_, true) != wanted_.end())
        paintFrame(layer ? &covered_ : nullptr, paint, shadows);
    threadPool_.parallelFor(grid_.rows(), SampleRow{this, shown_.frame, painted()});
    if (drawn_.size() < states_.size()) {
        glBindTexture(GL_TEXTURE_2D, picture.canvas.texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, shown_.size.x, shown_.size.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        picture_.data());
    }
    return drawCells(picture, layer);
}

// Chooses tiles by the layer's pixels: spheres around objects hold more of the film than the objects hide.
void SoftwareBackground::findCovered(const TexelLayer& layer, const TexelPaint& paint) {
    covered_.clear(layer.tiles.frameSize());
    layer.tiles.eachChosen([&](const glm::ivec2& tile) {
        if (showsAnything(layer.layer, paint, layer.tiles, tile)) covered_.choose(tile);
    });
}

DisplayFrame SoftwareBackground::painted() const {
    return {reinterpret_cast<const uint8_t*>(texels_.get()), texelsSize_.x, texelsSize_.y, texelsSize_.x};
}

TexelPaint SoftwareBackground::paintOf(const EyePicture& picture, const TexelLayer& layer) {
    TexelPaint paint{.layer = layer.layer.pixels().data(),
                     .layerSize = layer.layer.size(),
                     .eyeFromEnv =
                         glm::transpose(picture.envFromWorld * glm::mat3_cast(layer.view.worldFromEye)),
                     .rayScale = layer.view.halfExtent(),
                     .rayShift = layer.view.shift};
    if (layer.filmed) {
        if (grain_.empty()) grain_ = makeGrain();
        uniforms_ = cameraUniforms(picture.filmed);
        paint.filmed = &uniforms_;
        paint.grain = grain_.data();
        paint.scattered = &picture.environment.scatteredLight();
    }
    return paint;
}

// Paints the wanted tiles: the frame's texels, dimmed where shadows are, and objects over them.
void SoftwareBackground::paintFrame(const FrameTiles* objects, const TexelPaint& paint,
                                    const FilmShadows* shadows) {
    const DisplayFrame& frame = shown_.frame;
    const glm::ivec2 size(frame.width, frame.height);
    if (size != texelsSize_) {
        texelsSize_ = size;
        texels_ = std::make_unique_for_overwrite<uint32_t[]>(static_cast<size_t>(size.x) *
                                                             static_cast<size_t>(size.y));
    }
    runs_.clear();
    eachRun(wanted_, FrameTiles::kCount, [&](int first, int end, int row) {
        runs_.push_back({row, first, end});
    });
    threadPool_.parallelFor(static_cast<int>(runs_.size()), [&](int index) {
        const Run& run = runs_[static_cast<size_t>(index)];
        for (int column = run.first; column < run.end; ++column) {
            const glm::ivec2 low = FrameTiles::lowOf({column, run.row}, size),
                             high = FrameTiles::lowOf({column + 1, run.row + 1}, size);
            const auto tile = static_cast<size_t>(run.row * FrameTiles::kCount.x + column);
            const bool shaded = shadows && shadows->tiles().chosen()[tile];
            const bool covered = objects && objects->chosen()[tile];
            if (shaded) shadeTexels(frame, shadows->left(), low, high, texels_.get(), size.x);
            if (covered) paintTexels(shaded ? painted() : frame, paint, low, high, texels_.get(), size.x);
            if (!shaded && !covered) copyTexels(frame, low, high, texels_.get(), size.x);
        }
    });
}

} // namespace shoal::render
