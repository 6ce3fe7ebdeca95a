// Finds the cells of a grid over the lat-long map that a cap of the sphere touches.
#pragma once

#include "engine/math/LatLong.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shoal {

struct CellRange {
    glm::ivec2 first{0}, last{-1}; // rows are within the grid; columns may lie beyond an edge, and repeat
};

// Returns the cells that a cap touches. The cap's outermost meridians are sin(longitude) = sin(angle) /
// cos(latitude) from its middle; a cap that holds a pole touches all. dirEnv: unit; halfAngle: radians.
inline CellRange cellsOfCap(const glm::ivec2& cells, const glm::vec3& dirEnv, float halfAngle) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const glm::vec2 uv = latLongFromDirection(dirEnv);
    const float latitude = (0.5f - uv.y) * kPi;
    const bool polar = std::abs(latitude) + halfAngle >= kPi / 2;
    const float across = polar ? 0.5f : std::asin(std::sin(halfAngle) / std::cos(latitude)) / (2 * kPi);
    const auto cell = [](float share, int count) {
        return static_cast<int>(std::floor(share * static_cast<float>(count)));
    };
    const int left = cell(uv.x - across, cells.x);
    return {{left, std::max(cell(uv.y - halfAngle / kPi, cells.y), 0)},
            {std::min(cell(uv.x + across, cells.x), left + cells.x - 1),
             std::min(cell(uv.y + halfAngle / kPi, cells.y), cells.y - 1)}};
}

} // namespace shoal
