#include "engine/depth/DepthRange.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"

#include <algorithm>

namespace shoal::depth {

namespace {

SHOAL_VECTORISE void addRow(const uint8_t* codes, size_t count, uint8_t* min, uint8_t* max) {
    for (size_t x = 0; x < count; ++x) {
        min[x] = std::min(min[x], codes[x]);
        max[x] = std::max(max[x], codes[x]);
    }
}

} // namespace

void DepthRange::make(const DepthMap& map) {
    const int width = map.inverse.width, height = map.inverse.height;
    cells_.assign(static_cast<size_t>(kCells.x) * kCells.y, {});
    for (int row = 0; row < kCells.y; ++row) {
        columnMin_.assign(static_cast<size_t>(width), 255);
        columnMax_.assign(static_cast<size_t>(width), 0);
        for (int y = row * height / kCells.y; y < (row + 1) * height / kCells.y; ++y)
            addRow(map.inverse.at(0, y), columnMin_.size(), columnMin_.data(), columnMax_.data());
        for (int x = 0; x < width; ++x) {
            Codes& cell = cells_[static_cast<size_t>(row) * kCells.x + x * kCells.x / width];
            cell.min = std::min(cell.min, columnMin_[static_cast<size_t>(x)]);
            cell.max = std::max(cell.max, columnMax_[static_cast<size_t>(x)]);
        }
    }
}

DepthRange::Range DepthRange::around(const glm::vec3& dirEnv, float halfAngle) const {
    if (cells_.empty()) return {};
    constexpr float kTexel = 0.01f; // radians by which interpolation reaches beyond an edge
    const CellRange range = cellsOfCap(kCells, dirEnv, halfAngle + kTexel);
    Codes codes;
    for (int y = range.first.y; y <= range.last.y; ++y)
        for (int x = range.first.x; x <= range.last.x; ++x) {
            const Codes& cell = cells_[static_cast<size_t>(y * kCells.x + (x + 2 * kCells.x) % kCells.x)];
            codes.min = std::min(codes.min, cell.min);
            codes.max = std::max(codes.max, cell.max);
        }
    return {DepthMap::perM(codes.min), DepthMap::perM(codes.max)};
}

} // namespace shoal::depth
