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

// Returns pixels low to high - 1 of a picture that is enlarged to `size`.
SampledCell enlarged(const DisplayFrame& picture, const glm::ivec2& low, const glm::ivec2& high,
                     const glm::ivec2& size) {
    const glm::vec2 scale = glm::vec2(picture.width, picture.height) / glm::vec2(size);
    return {{0, 0}, high - low, (glm::vec2(low) + 0.5f) * scale - 0.5f, {scale.x, 0}, {0, scale.y}};
}

// Writes these pixels. Places up to half a pixel beyond the picture's edge take its outermost pixels.
void enlarge(const DisplayFrame& picture, const glm::ivec2& low, const glm::ivec2& high,
             const glm::ivec2& size, std::vector<uint32_t>& out) {
    constexpr float kInside = 1 / 32.0f;
    SampledCell cell = enlarged(picture, low, high, size);
    const glm::vec2 inside(kInside), last = glm::vec2(picture.width, picture.height) - 1.0f - kInside;
    const glm::vec2 steps = cell.high - 1;
    const glm::vec2 end = glm::clamp(cell.first + steps * glm::vec2(cell.right.x, cell.up.y), inside, last);
    cell.first = glm::clamp(cell.first, inside, last);
    cell.right.x = (end.x - cell.first.x) / std::max(steps.x, 1.0f);
    cell.up.y = (end.y - cell.first.y) / std::max(steps.y, 1.0f);
    out.resize(static_cast<size_t>(cell.high.x) * static_cast<size_t>(cell.high.y));
    sampleCell(picture, cell, out.data(), cell.high.x);
}

// Multiplies bytes: a b / 255, rounded.
SHOAL_VECTORISE void multiply(const uint8_t* a, const uint8_t* b, size_t count, uint8_t* out) {
    for (size_t i = 0; i < count; ++i) {
        const unsigned product = a[i] * b[i] + 128u;
        out[i] = static_cast<uint8_t>((product + (product >> 8)) >> 8);
    }
}

// Lays pixels over others: a + (1 - alpha) b. Edges are at most 1 of 255 darker, so that no sum of rounded
// numbers exceeds a byte.
SHOAL_VECTORISE void layOver(const uint32_t* layer, size_t count, uint32_t* picture) {
    constexpr uint32_t kEach = 0x00ff00ff, kHalf = 0x00800080; // every other channel; half of 255 for each
    for (size_t i = 0; i < count; ++i) {
        const uint32_t alpha = layer[i] >> 24, below = picture[i];
        const uint32_t left = 255 - alpha - (alpha > 0 && alpha < 255 ? 1 : 0);
        const uint32_t even = (below & kEach) * left + kHalf, odd = (below >> 8 & kEach) * left + kHalf;
        picture[i] =
            layer[i] + ((even + (even >> 8 & kEach)) >> 8 & kEach) + ((odd + (odd >> 8 & kEach)) & ~kEach);
    }
}

// Places of a picture's pixels in a layer of objects, in its pixels.
struct LayerPlaces {
    glm::vec2 first, step;
    glm::ivec2 at(const glm::ivec2& pixel) const { return glm::floor(first + step * glm::vec2(pixel)); }
};

LayerPlaces placesIn(const ObjectLayer& layer, const EyePicture& picture) {
    const View &from = picture.view, &to = layer.view;
    const glm::vec2 size(layer.layer.size()), perSlope = 0.5f * size / to.halfExtent();
    return {0.5f * size + (from.shift - to.shift - from.halfExtent()) * perSlope,
            2.0f * from.halfExtent() * perSlope / glm::vec2(picture.size())};
}

// Returns whether a layer holds objects within a cell of the picture.
bool hasObjects(const ObjectLayer& layer, const LayerPlaces& places, const BackgroundCell& cell) {
    // A texel that shares its chroma and is filtered takes colours from two texels around it, and from one
    // pixel more. A texel is at most two of the layer's pixels wide in the picture's middle (sizeAsFine(),
    // layerTexels()), and wider beside it by the square of a ray's length to the image plane.
    float stretch = 1;
    for (const glm::vec3& ray : cell.directions) stretch = std::max(stretch, glm::dot(ray, ray));
    const int beside = layer.tiles ? static_cast<int>(4 * stretch) + 2 : 2;
    return layer.layer.holdsAnything(places.at(cell.low) - beside, places.at(cell.high) + 1 + beside);
}

TexelPaint paintOf(const EyePicture& picture, const ObjectLayer& layer) {
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
        if (const State& state = eye.states[k]; state.due) {
            if (!state.isSampled)
                sampleCell(state.isPainted ? painted : eye.film.frame, state.sampled, eye.picture.data(),
                           eye.film.size.x);
            if (state.isUnderLayer) pass->layOverCell(state.sampled.low, state.sampled.high);
        }
}

void SoftwareBackground::layOverCell(const glm::ivec2& low, const glm::ivec2& high) const {
    thread_local std::vector<uint32_t> objects;
    enlarge(over_, low, high, eye_->film.size, objects);
    const auto width = static_cast<size_t>(high.x - low.x);
    for (int y = low.y; y < high.y; ++y)
        render::layOver(objects.data() + static_cast<size_t>(y - low.y) * width, width,
                        eye_->picture.data() + ptrdiff_t{y} * eye_->film.size.x + low.x);
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
        if (!state.due) continue;
        state.shows = FilmShadows::Version();
        state.isSampled = state.isPainted = state.isUnderLayer = false;
    }
    threadPool_.start(kParts, samplePart_);
    started_ = true;
}

Status SoftwareBackground::draw(const EyePicture& picture, const ObjectLayer* layer) {
    if (!canSample(picture)) return BackgroundPass::draw(picture, layer);
    const FrameTiles* tiles = layer ? layer->tiles : nullptr;
    if (!started_) prepare(picture, tiles);
    timed(picture.partTimes(), "wait for the background", [&] { threadPool_.finish(); });
    started_ = false;
    cellsToDraw_.clear();
    corners_.clear();
    tilesToPaint_.assign(FrameTiles::kAll, false);
    const FilmShadows* shadows = picture.seenShadows(); // may have been cast since prepare()
    const LayerPlaces places = layer ? placesIn(*layer, picture) : LayerPlaces();
    if (layer) {
        const auto* pixels = reinterpret_cast<const uint8_t*>(layer->layer.pixels().data()); // reads them
        over_ = {pixels, layer->layer.size().x, layer->layer.size().y, layer->layer.size().x};
    }
    for (size_t k = 0; k < eye_->states.size(); ++k) {
        const BackgroundCell& cell = eye_->grid.all()[k];
        State& state = eye_->states[k];
        const bool objects =
            layer && (!tiles || tiles->isChosen(state.tiles)) && hasObjects(*layer, places, cell);
        if (!state.here) cellsToDraw_.push_back({&cell, objects && tiles});
        state.isUnderLayer = objects && !tiles && state.here &&
                             isWithin(over_, enlarged(over_, cell.low, cell.high, picture.size()));
        if (objects && !tiles && !state.isUnderLayer)
            addRectangle(2.0f * glm::vec2(cell.low) / glm::vec2(picture.size()) - 1.0f,
                         2.0f * glm::vec2(cell.high) / glm::vec2(picture.size()) - 1.0f, corners_);
        const bool shaded = shadows && shadows->tiles().isChosen(state.tiles);
        const FilmShadows::Version shown = shaded ? shadows->version() : FilmShadows::Version();
        state.due = state.here && (objects || state.shows != shown);
        if (!state.due) continue;
        state.isSampled = !tiles && state.shows == shown;
        state.shows = objects ? std::nullopt : std::optional(shown);
        state.isPainted = !state.isSampled && (shaded || (objects && tiles));
        if (state.isPainted) markTiles(state.tiles);
    }
    timed(picture.partTimes(), "compositing", [&] {
        paintFrame(picture, tiles ? layer : nullptr);
        threadPool_.parallelFor(kParts, samplePart_);
    });
    if (cellsToDraw_.size() < eye_->states.size()) {
        const PartTimes::Scope part(picture.partTimes(), "upload");
        glBindTexture(GL_TEXTURE_2D, picture.canvas.texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, eye_->film.size.x, eye_->film.size.y, GL_BGRA,
                        GL_UNSIGNED_BYTE, eye_->picture.data());
    }
    if (Status s = drawCells(picture, layer); !s) return s;
    if (layer) layer->layer.layOver(corners_);
    return Done{};
}

// Writes the wanted tiles: the frame's texels, dimmed where shadows are, and objects over them.
void SoftwareBackground::paintFrame(const EyePicture& picture, const ObjectLayer* layer) {
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
        if (shaded) enlarge(frameOf(shadows->remaining()), low, high, size, factors);
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
        if (layer && layer->tiles->chosen()[number]) paintTexels(paint, low, high, size, texels_.get());
    });
}

} // namespace shoal::render
