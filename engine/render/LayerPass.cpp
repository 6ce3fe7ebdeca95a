#include "engine/render/LayerPass.h"

#include "engine/core/Vectorise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

// Cells of about 32 pixels each: laying over an empty one costs as much as any other.
constexpr glm::ivec2 kCells(40, 24);
// Greatest share of the picture's width that pays: laying a larger layer over takes more time than it saves.
constexpr float kWorthIt = 0.85f;
constexpr int kBlock = 8; // pixels on a side

// Marks the blocks in which a row of pixels holds something.
SHOAL_VECTORISE void markRow(const uint32_t* row, int width, uint32_t* blocks) {
    const int whole = width / kBlock;
    for (int block = 0; block < whole; ++block) {
        uint32_t any = 0;
        for (int x = 0; x < kBlock; ++x) any |= row[block * kBlock + x];
        blocks[block] |= any;
    }
    for (int x = whole * kBlock; x < width; ++x) blocks[whole] |= row[x];
}

} // namespace

glm::ivec2 sizeAsFine(const View& view, glm::ivec2 pixels, int frameRows) {
    const float rowsPerSlope = static_cast<float>(frameRows) / std::numbers::pi_v<float>;
    const float scale = rowsPerSlope * 2 * view.halfExtent().y / static_cast<float>(pixels.y);
    if (scale > kWorthIt) return pixels;
    return glm::max(glm::ivec2(glm::ceil(glm::vec2(pixels) * scale)), 1);
}

View widened(const View& view, float factor) {
    View wide = view;
    wide.verticalFov = 2 * std::atan(factor * std::tan(view.verticalFov / 2));
    return wide;
}

Result<LayerPass> LayerPass::make() {
    LayerPass pass;
    if (Status s = gl::Program::load("render/Layer").moveTo(pass.program_); !s) return s.error();
    pass.drawn_ = TriangleBatch::make();
    return pass;
}

void LayerPass::begin(glm::ivec2 size, int samples) {
    if (!layer_ || layer_->width() != size.x || layer_->height() != size.y || samples_ != samples) {
        layer_.emplace(size.x, size.y, samples);
        samples_ = samples;
    }
    areRead_ = areNewer_ = false;
    layer_->bind();
    glDepthMask(GL_TRUE);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::vector<uint32_t>& LayerPass::pixels() {
    if (areRead_) return pixels_;
    areRead_ = true;
    layer_->readBgra(pixels_);
    const glm::ivec2 size = this->size();
    const auto columns = static_cast<size_t>(size.x / kBlock + 1);
    blocks_.assign(columns * static_cast<size_t>(size.y / kBlock + 1), 0);
    for (int y = 0; y < size.y; ++y)
        markRow(pixels_.data() + ptrdiff_t{y} * size.x, size.x,
                blocks_.data() + static_cast<size_t>(y / kBlock) * columns);
    return pixels_;
}

void LayerPass::smoothOutlines() {
    render::smoothOutlines(pixels(), size(), changed_, [this](const glm::ivec2& low, const glm::ivec2& high) {
        return holdsAnything(low, high);
    });
    areNewer_ = true;
}

// Uploads smoothed pixels first: most frames are painted from the pixels alone.
const gl::Target& LayerPass::layer() {
    if (areNewer_) {
        glBindTexture(GL_TEXTURE_2D, layer_->texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, layer_->width(), layer_->height(), GL_BGRA, GL_UNSIGNED_BYTE,
                        pixels_.data());
        areNewer_ = false;
    }
    return *layer_;
}

bool LayerPass::holdsAnything(const glm::ivec2& low, const glm::ivec2& high) const {
    const glm::ivec2 first = glm::max(low, 0) / kBlock, last = glm::min(high - 1, size() - 1) / kBlock;
    for (int y = first.y; y <= last.y; ++y) {
        const uint32_t* row = blocks_.data() + ptrdiff_t{y} * (size().x / kBlock + 1);
        if (std::any_of(row + first.x, row + std::max(last.x + 1, first.x),
                        [](uint32_t block) { return block != 0; }))
            return true;
    }
    return false;
}

void LayerPass::layOver() {
    const auto isDrawn = [&](int x, int y) {
        const glm::ivec2 cell(x, y);
        // The range has a texel more on each side, which the filter reaches.
        return holdsAnything(cell * size() / kCells - 1, (cell + 1) * size() / kCells + 2);
    };
    const auto placeOf = [](int x, int y) { return glm::vec2(x, y) / glm::vec2(kCells) * 2.0f - 1.0f; };
    corners_.clear();
    if (!areRead_) addRectangle(glm::vec2(-1), glm::vec2(1), corners_);
    for (int y = 0; areRead_ && y < kCells.y; ++y)
        for (int x = 0; x < kCells.x; ++x) {
            const int first = x;
            while (x < kCells.x && isDrawn(x, y)) ++x;
            if (x > first) addRectangle(placeOf(first, y), placeOf(x, y + 1), corners_);
        }
    layOver(corners_);
}

void LayerPass::layOver(const std::vector<glm::vec2>& corners) {
    if (corners.empty()) return;
    program_.use();
    program_.setTexture("layer", 0, layer().texture());
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied
    drawn_.draw(corners);
    glDisable(GL_BLEND);
}

} // namespace shoal::render
