#include "engine/render/BackgroundCells.h"

#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace shoal::render {

namespace {

// Of the image plane at distance 1. Of a 2048 wide video at most 0.1 texels off up to 45 degrees of latitude,
// 0.2 where polar cells begin.
constexpr float kCell = 0.04f;
constexpr float kPolarV = 0.3234f; // of the map's height, from its middle: a latitude whose sine is 0.85

// Where cells meet: whole pixels, of larger pictures eight at a time, which are sampled together.
void findEdges(float halfExtent, int pixels, std::vector<int>& edges) {
    const int wanted = std::clamp(static_cast<int>(std::ceil(2 * halfExtent / kCell)), 1, 256);
    const int cells = std::clamp(wanted, 1, std::max(pixels, 1)), step = pixels / cells >= 16 ? 8 : 1;
    edges.clear();
    for (int k = 0; k < cells; ++k)
        edges.push_back(static_cast<int>(int64_t{k} * pixels / cells) / step * step);
    edges.push_back(pixels);
}

// So coarse that sums of a few of them are exact: corners then lie in one plane to the last bit, by which
// llvmpipe knows a rectangle. 1/1024 texel of a 2048 wide video.
glm::vec2 rounded(const glm::vec2& uv) {
    constexpr float kSteps = 1 << 21;
    return glm::round(uv * kSteps) / kSteps;
}

} // namespace

void BackgroundCells::make(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size) {
    const glm::vec2 half = view.halfExtent();
    findEdges(half.x, size.x, columns_);
    findEdges(half.y, size.y, rows_);
    uvs_.clear();
    for (const int y : rows_)
        for (const int x : columns_) {
            const glm::vec2 place = 2.0f * glm::vec2(x, y) / glm::vec2(size) - 1.0f;
            uvs_.push_back(
                latLongFromDirection(glm::normalize(envFromRay * glm::vec3(place * half + view.shift, -1))));
        }
    cells_.clear();
    for (size_t y = 0; y + 1 < rows_.size(); ++y)
        for (size_t x = 0; x + 1 < columns_.size(); ++x) {
            const size_t at = y * columns_.size() + x, above = at + columns_.size();
            std::array<glm::vec2, 4> uv = {uvs_[at], uvs_[at + 1], uvs_[above], uvs_[above + 1]};
            // The map repeats: all corners on one side of the seam.
            for (glm::vec2& each : uv) each.x += std::round(uv[0].x - each.x);
            BackgroundCell cell{{columns_[x], rows_[y]}, {columns_[x + 1], rows_[y + 1]}};
            cell.right = rounded(0.5f * (uv[1] - uv[0] + uv[3] - uv[2]));
            cell.up = rounded(0.5f * (uv[2] - uv[0] + uv[3] - uv[1]));
            cell.first = rounded(0.25f * (uv[0] + uv[1] + uv[2] + uv[3]) - 0.5f * (cell.right + cell.up));
            cell.polar = std::abs(uv[0].y - 0.5f) > kPolarV;
            cells_.push_back(cell);
        }
}

} // namespace shoal::render
