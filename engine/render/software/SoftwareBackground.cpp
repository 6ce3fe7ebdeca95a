#include "engine/render/software/SoftwareBackground.h"

#include "engine/gl/Renderer.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/software/PaintTexels.h"

#include <algorithm>
#include <thread>

namespace shoal::render {

namespace {

bool canSample(const EyePicture& picture) {
    return canSampleFrames() && showsFrameAsCoded(picture.environment, picture.exposure) &&
           picture.canvas.samples() == 1 && !glIsEnabled(GL_STENCIL_TEST);
}

} // namespace

Result<std::unique_ptr<BackgroundPass>> makeBackgroundPass(Backend backend, bool withLayers) {
    if (backend == Backend::Auto)
        backend = gl::rendersInSoftware() && canSampleFrames() ? Backend::Software : Backend::OpenGL;
    return backend == Backend::Software ? SoftwareBackground::make(withLayers)
                                        : BackgroundPass::make(withLayers);
}

SoftwareBackground::SoftwareBackground()
    : threadPool_(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1) {}

Result<std::unique_ptr<BackgroundPass>> SoftwareBackground::make(bool withLayers) {
    std::unique_ptr<SoftwareBackground> pass(new SoftwareBackground);
    if (Status s = pass->setUp(withLayers); !s) return s.error();
    return std::unique_ptr<BackgroundPass>(std::move(pass));
}

void SoftwareBackground::SampleRow::operator()(int row) const {
    const auto r = static_cast<size_t>(row);
    for (size_t k = pass->dueRow_[r]; k < pass->dueRow_[r + 1]; ++k)
        sampleCell(frame, pass->states_[pass->due_[k]].sampled, pass->picture_.data(), pass->shown_.size.x);
}

void SoftwareBackground::classify(const View& view) {
    grid_.make(view, shown_.envFromRay, shown_.size);
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

// due(state): whether that cell is to be sampled next.
template <class Due> void SoftwareBackground::collect(Due&& due) {
    due_.clear();
    dueRow_.clear();
    for (size_t k = 0; k < states_.size(); ++k) {
        if (grid_.all()[k].low.x == 0) dueRow_.push_back(due_.size());
        if (due(states_[k])) due_.push_back(k);
    }
    dueRow_.push_back(due_.size());
}

void SoftwareBackground::prepare(const EyePicture& picture, const FrameTiles* tiles) {
    if (!canSample(picture)) return;
    if (started_) threadPool_.finish(); // of a picture that nobody wanted
    const Shown shown{picture.environment.displayFrame(),
                      picture.environment.frameNumber(),
                      picture.view.halfExtent(),
                      picture.view.shift,
                      picture.envFromEye(),
                      picture.size()};
    const bool same = !states_.empty() && shown == shown_;
    shown_ = shown;
    if (!same) classify(picture.view);
    for (size_t k = 0; k < states_.size(); ++k) {
        const BackgroundCell& cell = grid_.all()[k];
        states_[k].painted = tiles && tiles->isChosen(cell.mapLow(), cell.mapHigh());
    }
    collect([](State& s) {
        const bool due = s.here && !s.painted && !s.clean;
        s.clean = s.here && !s.painted;
        return due;
    });
    sampleRow_ = {this, shown_.frame};
    threadPool_.start(rows(), sampleRow_);
    started_ = true;
}

Status SoftwareBackground::draw(const EyePicture& picture, const TexelLayer* layer) {
    if (!canSample(picture)) return BackgroundPass::draw(picture, layer);
    if (!started_) prepare(picture, layer ? &layer->tiles : nullptr);
    threadPool_.finish();
    started_ = false;
    drawn_.clear();
    wanted_.assign(FrameTiles::kAll, false);
    bool anyPainted = false, paintedLeft = false;
    for (size_t k = 0; k < states_.size(); ++k) {
        const BackgroundCell& cell = grid_.all()[k];
        const bool painted = layer && states_[k].painted;
        if (painted) want(layer->tiles, cell);
        anyPainted |= painted;
        if (states_[k].here) continue;
        drawn_.push_back({&cell, painted});
        paintedLeft |= painted;
    }
    if (anyPainted) paintObjects(picture, *layer);
    if (drawn_.size() < states_.size()) {
        glBindTexture(GL_TEXTURE_2D, picture.canvas.texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, shown_.size.x, shown_.size.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        picture_.data());
    }
    if (paintedLeft) uploadPainted();
    return drawCells(picture, drawn_, painted_.name());
}

// Into the wanted tiles, and those cells of the picture that show them.
void SoftwareBackground::paintObjects(const EyePicture& picture, const TexelLayer& layer) {
    const gl::Target& drawn = layer.layer.layer();
    drawn.readBgra(layer_);
    TexelPaint paint{.layer = layer_.data(),
                     .layerSize = {drawn.width(), drawn.height()},
                     .eyeFromEnv =
                         glm::transpose(picture.envFromWorld * glm::mat3_cast(layer.view.worldFromEye)),
                     .rayScale = layer.view.halfExtent(),
                     .rayShift = layer.view.shift};
    CameraUniforms uniforms;
    if (layer.filmed) {
        if (grain_.empty()) grain_ = makeGrain();
        uniforms = cameraUniforms(picture.filmed);
        paint.filmed = &uniforms;
        paint.grainy = (cameraFeatures(picture.filmed.response) & kGrainy) != 0;
        paint.grain = grain_.data();
        paint.scattered = &picture.environment.scatteredLight();
    }
    paintFrame(layer.tiles, paint);
    collect([](const State& s) { return s.here && s.painted; });
    const auto* pixels = reinterpret_cast<const uint8_t*>(texels_.get());
    threadPool_.parallelFor(rows(), SampleRow{this, {pixels, texelsSize_.x, texelsSize_.y, texelsSize_.x}});
}

// Of the wanted tiles those that are chosen are painted, others copied.
void SoftwareBackground::paintFrame(const FrameTiles& tiles, const TexelPaint& paint) {
    const DisplayFrame& frame = shown_.frame;
    const glm::ivec2 size(frame.width, frame.height);
    if (size != texelsSize_) {
        texelsSize_ = size;
        texels_ = std::make_unique_for_overwrite<uint32_t[]>(static_cast<size_t>(size.x) *
                                                             static_cast<size_t>(size.y));
    }
    runs_.clear();
    eachRun(wanted_, FrameTiles::kCount, [&](int first, int end, int row) {
        const glm::ivec2 low = tiles.lowOf({first, row}), high = tiles.lowOf({end, row + 1});
        if (low.x < high.x && low.y < high.y) runs_.push_back({row, first, end, low, high});
    });
    threadPool_.parallelFor(static_cast<int>(runs_.size()), [&](int index) {
        const Run& run = runs_[static_cast<size_t>(index)];
        for (int column = run.first; column < run.end; ++column) {
            const glm::ivec2 low = tiles.lowOf({column, run.row}),
                             high = tiles.lowOf({column + 1, run.row + 1});
            if (tiles.chosen()[static_cast<size_t>(run.row * FrameTiles::kCount.x + column)]) {
                paintTexels(frame, paint, low, high, texels_.get(), size.x);
                continue;
            }
            const auto* from = reinterpret_cast<const uint32_t*>(frame.pixels);
            for (int y = low.y; y < high.y; ++y)
                std::copy_n(from + ptrdiff_t{y} * frame.rowPixels + low.x, high.x - low.x,
                            texels_.get() + ptrdiff_t{y} * size.x + low.x);
        }
    });
}

void SoftwareBackground::uploadPainted() {
    if (texelsSize_ != paintedSize_) {
        paintedSize_ = texelsSize_;
        painted_ = makeLatLongTexture();
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, paintedSize_.x, paintedSize_.y, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                     nullptr);
    }
    glBindTexture(GL_TEXTURE_2D, painted_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, texelsSize_.x);
    for (const Run& run : runs_)
        glTexSubImage2D(GL_TEXTURE_2D, 0, run.low.x, run.low.y, run.high.x - run.low.x,
                        run.high.y - run.low.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        texels_.get() + ptrdiff_t{run.low.y} * texelsSize_.x + run.low.x);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace shoal::render
