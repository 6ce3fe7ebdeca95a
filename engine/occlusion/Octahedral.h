// Unit vectors as two numbers: projected onto an octahedron and flattened. Meyer et al. 2010, "On
// Floating-Point Normal Vectors".
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// direction: unit. Result in [-1, 1]^2.
inline glm::vec2 squareFromDirection(const glm::vec3& direction) {
    const glm::vec3 a = glm::abs(direction);
    const glm::vec2 flat = glm::vec2(direction) / (a.x + a.y + a.z);
    if (direction.z >= 0) return flat;
    return (1.0f - glm::abs(glm::vec2(flat.y, flat.x))) *
           glm::vec2(flat.x < 0 ? -1.0f : 1.0f, flat.y < 0 ? -1.0f : 1.0f);
}

inline glm::vec3 directionFromSquare(const glm::vec2& square) {
    glm::vec3 v(square, 1.0f - std::abs(square.x) - std::abs(square.y));
    const float wrap = v.z < 0 ? -v.z : 0.0f;
    v.x -= v.x < 0 ? -wrap : wrap;
    v.y -= v.y < 0 ? -wrap : wrap;
    return v / std::sqrt(glm::dot(v, v));
}

// Signed steps of 1 / (2^(bits - 1) - 1), x in the low half; bits: of each coordinate, 2 to 16. With 8 the
// angle is off by at most 0.0167 rad, with 16 by 6.5e-5.
inline uint32_t packDirection(const glm::vec3& direction, int bits) {
    const auto top = static_cast<float>((1 << (bits - 1)) - 1);
    const glm::vec2 square = squareFromDirection(direction);
    const uint32_t mask = (1u << bits) - 1;
    const auto x = static_cast<uint32_t>(static_cast<int>(std::lround(square.x * top))) & mask;
    const auto y = static_cast<uint32_t>(static_cast<int>(std::lround(square.y * top))) & mask;
    return x | y << bits;
}

inline glm::vec3 unpackDirection(uint32_t packed, int bits) {
    const int up = 32 - bits; // shifts the sign to the top and back
    const auto top = static_cast<float>((1 << (bits - 1)) - 1);
    const int x = static_cast<int32_t>(packed << up) >> up;
    const int y = static_cast<int32_t>(packed >> bits << up) >> up;
    return directionFromSquare(glm::vec2(static_cast<float>(x), static_cast<float>(y)) / top);
}

} // namespace shoal::occlusion
