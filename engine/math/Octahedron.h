// Maps directions to a square, the unfolded octahedron (Meyer et al. 2010, "On Floating-Point Normal
// Vectors"). +Y is in the middle, -Y in the corners. It uses only sums, products, quotients and a square
// root, so that results are the same on every machine.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::math {

// dir: of any length but 0. Returns coordinates in [-1, 1]^2: along X, along Z.
inline glm::vec2 octahedralFromDirection(const glm::vec3& dir) {
    const auto sign = [](float x) { return x < 0 ? -1.0f : 1.0f; };
    const float sum = std::abs(dir.x) + std::abs(dir.y) + std::abs(dir.z);
    const float x = dir.x / sum, z = dir.z / sum;
    if (dir.y >= 0) return {x, z};
    return {(1 - std::abs(z)) * sign(x), (1 - std::abs(x)) * sign(z)};
}

// Returns the direction, of unit length.
inline glm::vec3 directionFromOctahedral(const glm::vec2& square) {
    const auto sign = [](float x) { return x < 0 ? -1.0f : 1.0f; };
    const float y = 1 - std::abs(square.x) - std::abs(square.y), over = std::max(-y, 0.0f);
    return glm::normalize(glm::vec3(square.x - over * sign(square.x), y, square.y - over * sign(square.y)));
}

// Returns the direction's cell in a grid of side x side cells, row by row. dir: of any length but 0.
inline int octahedralCell(const glm::vec3& dir, int side) {
    const glm::vec2 place = (octahedralFromDirection(dir) + 1.0f) * (0.5f * static_cast<float>(side));
    const int column = std::clamp(static_cast<int>(place.x), 0, side - 1);
    return std::clamp(static_cast<int>(place.y), 0, side - 1) * side + column;
}

// Returns the direction of a cell's middle, of unit length.
inline glm::vec3 octahedralDirection(int cell, int side) {
    const glm::vec2 middle = glm::vec2(cell % side, cell / side) + 0.5f;
    return directionFromOctahedral(middle / (0.5f * static_cast<float>(side)) - 1.0f);
}

} // namespace shoal::math
