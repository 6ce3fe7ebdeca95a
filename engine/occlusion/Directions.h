// Axes spread over a hemisphere, frames around a direction, and packed unit vectors.
#pragma once

#include "engine/math/Octahedron.h"

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include <cstdint>
#include <numbers>
#include <vector>

namespace shoal::occlusion {

// The golden angle, radians: successive points of a spiral at this angle never line up.
inline constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002103; // 3 - sqrt 5

// Axes spread over a hemisphere (a Fibonacci lattice), each for rays in both directions. A shader finds the
// nearest axis in the table.
struct Axes {
    static constexpr int kTableWidth = 64;

    explicit Axes(int count = 0); // 0 to 65536

    std::vector<glm::vec3> axes;
    // The index of the axis nearest to +-each direction: kTableWidth rows over the half of the octahedron
    // with z >= 0, turned by 45 degrees so that it fills the square.
    std::vector<uint16_t> table;
};

// Returns a right-handed frame with +Z along a unit normal; continuous but for one point. Duff et al. 2017,
// "Building an Orthonormal Basis, Revisited".
glm::mat3 frameAround(const glm::vec3& normal);

// Returns a rotation whose third row is `axis` (unit), the others turned by `turn` radians around it.
glm::mat3 lookingAlong(const glm::vec3& axis, float turn);

// Packs unit vectors as two numbers, on an octahedron unfolded around +Z: signed steps of 1 / (2^(bits - 1) -
// 1), x in the low half; bits: of each coordinate, 8 or 16. With 8 the angle is off by at most 0.0167 rad,
// with 16 by 6.5e-5.
inline uint32_t packDirection(const glm::vec3& direction, int bits) {
    const glm::vec2 square = math::octahedralFromDirection({direction.x, direction.z, direction.y});
    return bits == 8 ? glm::packSnorm2x8(square) : glm::packSnorm2x16(square);
}

} // namespace shoal::occlusion
