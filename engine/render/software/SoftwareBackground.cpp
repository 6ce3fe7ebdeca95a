#include "engine/render/software/SoftwareBackground.h"

#include "engine/core/Vectorise.h"
#include "engine/render/software/PaintTexels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <thread>

namespace shoal::render {

namespace {

bool canSample(const EyePicture& picture) {
    return canSampleFrames() && picture.showsFrameAsCoded() && picture.canvas.samples() == 1;
}

// Writes the factors of FilmShadows::remaining(), enlarged linearly, for texels low to high - 1 of a frame.
// Places up to half a texel beyond the map's edge take its outermost texels.
void enlarge(const Image<uint8_t, 4>& left, const glm::ivec2& low, const glm::ivec2& high,
             const glm::ivec2& frameSize, std::vector<uint32_t>& out) {
    constexpr float kInside = 1 / 32.0f;
    const glm::vec2 mapSize(left.width, left.height), scale = mapSize / glm::vec2(frameSize);
    const auto placeOf = [&](const glm::ivec2& texel) {
        return glm::clamp((glm::vec2(texel) + 0.5f) * scale - 0.5f, glm::vec2(kInside),
                          mapSize - 1.0f - kInside);
    };
    const glm::ivec2 size = high - low;
    const glm::vec2 first = placeOf(low);
    const glm::vec2 step = (placeOf(high - 1) - first) / glm::vec2(glm::max(size - 1, 1));
    out.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
    sampleCell(frameOf(left), {{0, 0}, size, first, {step.x, 0}, {0, step.y}}, out.data(), size.x);
}

// Multiplies bytes: a b / 255, rounded.
SHOAL_VECTORISE void multiply(const uint8_t* a, const uint8_t* b, size_t count, uint8_t* out) {
    for (size_t i = 0; i < count; ++i) {
        const unsigned product = a[i] * b[i] + 128u;
        out[i] = static_cast<uint8_t>((product + (product >> 8)) >> 8);
    }
}

// Places of a picture's pixels in a layer of objects, in its pixels.
struct LayerPlaces {
    glm::vec2 first, step;
    glm::ivec2 at(const glm::ivec2& pixel) const { return glm::floor(first + step * glm::vec2(pixel)); }
};

LayerPlaces placesIn(const TexelLayer& layer, const EyePicture& picture) {
    const View &from = picture.view, &to = layer.view;
    const glm::vec2 size(layer.layer.size()), perSlope = 0.5f * size / to.halfExtent();
    return {0.5f * size + (from.shift - to.shift - from.halfExtent()) * perSlope,
            2.0f * from.halfExtent() * perSlope / glm::vec2(picture.size())};
}

// Returns whether a layer holds objects within a cell of the picture.
bool hasObjects(const TexelLayer& layer, const LayerPlaces& places, const BackgroundCell& cell) {
    // A texel that shares its chroma and is filtered takes colours from two texels around it, and from one
    // pixel more. A texel is at most two of the layer's pixels wide in the picture's middle (sizeAsFine(),
    // layerTexels()), and wider beside it by the square of a ray's length to the image plane.
    float stretch = 1;
    for (const glm::vec3& ray : cell.directions) stretch = std::max(stretch, glm::dot(ray, ray));
    const int beside = static_cast<int>(4 * stretch) + 2;
    return layer.layer.holdsAnything(places.at(cell.low) - beside, places.at(cell.high) + 1 + beside);
}

TexelPaint paintOf(const EyePicture& picture, const TexelLayer& layer) {
    TexelPaint paint{.layer = layer.layer.pixels().data(),
                     .layerSize = layer.layer.size(),
                     .eyeFromEnv =
                         glm::transpose(picture.envFromWorld * glm::mat3_cast(layer.view.worldFromEye)),
                     .rayScale = layer.view.halfExtent(),
                     .rayShift = layer.view.shift};
    if (layer.filmed) {
        paint.filmed = cameraUniforms(picture.filmed);
        paint.scattered = &picture.environment.scatteredLight();
    }
    return paint;
}

} // namespace

SoftwareBackground::SoftwareBackground()
    : threadPool_(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1) {}

void SoftwareBackground::SamplePart::operator()(int part) const {
    Eye& eye = *pass->eye_;
    const glm::ivec2& size = pass->texelsSize_;
    const DisplayFrame painted{reinterpret_cast<const uint8_t*>(pass->texels_.get()), size.x, size.y, size.x};
    const auto beginOf = [&](int k) { return static_cast<size_t>(k) * eye.states.size() / kParts; };
    for (size_t k = beginOf(part); k < beginOf(part + 1); ++k)
        if (const State& state = eye.states[k]; state.due)
            sampleCell(state.shows == FilmShadows::Version() ? eye.film.frame : painted, state.sampled,
                       eye.picture.data(), eye.film.size.x);
}

void SoftwareBackground::classify(const EyePicture& picture, Eye& eye) {
    const Sampled& film = eye.film;
    eye.grid.make(picture.view, film.envFromRay, film.size, picture.filmParallax());
    const depth::DepthMap* map = picture.environment.depth().map; // has tiles too, whose margin may be wider
    const glm::ivec2 frameSize(film.frame.width, film.frame.height),
        coarser = map ? glm::min(frameSize, {map->inverse.width, map->inverse.height}) : frameSize;
    const glm::vec2 texels(frameSize);
    eye.states.clear();
    for (const BackgroundCell& cell : eye.grid.all()) {
        const glm::vec2 right = cell.right * texels / static_cast<float>(cell.high.x - cell.low.x);
        const glm::vec2 up = cell.up * texels / static_cast<float>(cell.high.y - cell.low.y);
        const SampledCell sampled{cell.low, cell.high, cell.first * texels + 0.5f * (right + up) - 0.5f,
                                  right, up};
        eye.states.push_back({sampled, cell.tiles(coarser), !cell.polar && isWithin(film.frame, sampled)});
    }
    eye.picture.resize(static_cast<size_t>(film.size.x) * static_cast<size_t>(film.size.y));
}

void SoftwareBackground::prepare(const EyePicture& picture, const FrameTiles* tiles) {
    if (!canSample(picture)) return;
    if (started_) threadPool_.finish(); // stops the sampling of a picture that was never drawn
    const Sampled film{picture.environment.displayFrame(),
                       picture.environment.frameNumber(),
                       picture.view.halfExtent(),
                       picture.view.shift,
                       picture.envFromEye(),
                       picture.size(),
                       picture.filmParallax().eyeInFilm};
    eye_ = &eyes_[static_cast<size_t>(picture.eye)];
    const bool same = !eye_->states.empty() && film == eye_->film;
    eye_->film = film;
    if (!same) classify(picture, *eye_);
    const FilmShadows* shadows = picture.seenShadows();
    for (State& state : eye_->states) {
        state.due = state.here && state.shows != FilmShadows::Version() &&
                    !(shadows && shadows->tiles().isChosen(state.tiles)) &&
                    !(tiles && tiles->isChosen(state.tiles));
        if (state.due) state.shows = FilmShadows::Version();
    }
    threadPool_.start(kParts, samplePart_);
    started_ = true;
}

Status SoftwareBackground::draw(const EyePicture& picture, const TexelLayer* layer) {
    if (!canSample(picture)) return BackgroundPass::draw(picture, layer);
    if (!started_) prepare(picture, layer ? &layer->tiles : nullptr);
    timed(picture.partTimes(), "wait for the background", [&] { threadPool_.finish(); });
    started_ = false;
    cellsToDraw_.clear();
    tilesToPaint_.assign(FrameTiles::kAll, false);
    const FilmShadows* shadows = picture.seenShadows(); // may have been cast since prepare()
    const LayerPlaces places = layer ? placesIn(*layer, picture) : LayerPlaces();
    if (layer) layer->layer.pixels(); // reads them
    for (size_t k = 0; k < eye_->states.size(); ++k) {
        const BackgroundCell& cell = eye_->grid.all()[k];
        State& state = eye_->states[k];
        const bool objects = layer && layer->tiles.isChosen(state.tiles) && hasObjects(*layer, places, cell);
        if (!state.here) cellsToDraw_.push_back({&cell, objects});
        const bool shaded = shadows && shadows->tiles().isChosen(state.tiles);
        const FilmShadows::Version shown = shaded ? shadows->version() : FilmShadows::Version();
        state.due = state.here && (objects || state.shows != shown);
        if (!state.due) continue;
        state.shows = objects ? std::nullopt : std::optional(shown);
        if (shaded || objects) markTiles(state.tiles);
    }
    timed(picture.partTimes(), "compositing", [&] {
        paintFrame(picture, layer);
        threadPool_.parallelFor(kParts, samplePart_);
    });
    if (cellsToDraw_.size() < eye_->states.size()) {
        const PartTimes::Scope part(picture.partTimes(), "upload");
        glBindTexture(GL_TEXTURE_2D, picture.canvas.texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, eye_->film.size.x, eye_->film.size.y, GL_BGRA,
                        GL_UNSIGNED_BYTE, eye_->picture.data());
    }
    return drawCells(picture, layer);
}

// Writes the wanted tiles: the frame's texels, dimmed where shadows are, and objects over them.
void SoftwareBackground::paintFrame(const EyePicture& picture, const TexelLayer* layer) {
    tiles_.clear();
    FrameTiles::eachOf(tilesToPaint_, [&](const glm::ivec2& tile) { tiles_.push_back(tile); });
    if (tiles_.empty()) return;
    const DisplayFrame& frame = eye_->film.frame;
    const glm::ivec2 size(frame.width, frame.height);
    if (size != texelsSize_) {
        texelsSize_ = size;
        texels_ = std::make_unique_for_overwrite<uint32_t[]>(static_cast<size_t>(size.x) *
                                                             static_cast<size_t>(size.y));
    }
    const FilmShadows* shadows = picture.seenShadows();
    const TexelPaint paint = layer ? paintOf(picture, *layer) : TexelPaint();
    threadPool_.parallelFor(static_cast<int>(tiles_.size()), [&](int index) {
        thread_local std::vector<uint32_t> factors;
        const glm::ivec2& tile = tiles_[static_cast<size_t>(index)];
        const size_t number = FrameTiles::indexOf(tile.x, tile.y);
        const glm::ivec2 low = FrameTiles::lowOf(tile, size), high = FrameTiles::lowOf(tile + 1, size);
        if (low.x >= high.x || low.y >= high.y) return;
        const auto width = static_cast<size_t>(high.x - low.x);
        const bool shaded = shadows && shadows->tiles().chosen()[number];
        if (shaded) enlarge(shadows->remaining(), low, high, size, factors);
        for (int y = low.y; y < high.y; ++y) {
            const uint8_t* from = frame.pixels + 4 * (ptrdiff_t{y} * frame.rowPixels + low.x);
            auto* to = reinterpret_cast<uint8_t*>(texels_.get() + ptrdiff_t{y} * size.x + low.x);
            if (shaded)
                multiply(from,
                         reinterpret_cast<const uint8_t*>(&factors[static_cast<size_t>(y - low.y) * width]),
                         4 * width, to);
            else
                std::copy_n(from, 4 * width, to);
        }
        if (layer && layer->tiles.chosen()[number]) paintTexels(paint, low, high, size, texels_.get());
    });
}

} // namespace shoal::render
