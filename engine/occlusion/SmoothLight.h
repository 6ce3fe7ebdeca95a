// An environment map reduced for soft occlusion: one dominant light, and the radiance from a few directions.
#pragma once

#include "engine/core/Image.h"

#include <glm/glm.hpp>

#include <array>

namespace shoal::occlusion {

inline constexpr size_t kAxisCount = 24;
// Unit vectors that, with their opposites, are evenly spread over the sphere: shaders/occlusion/Axes.glsl.
extern const std::array<glm::vec3, kAxisCount> kAxes;

// Reduced light of an environment map, in the map's frame, which is also the axes'.
struct SmoothLight {
    // Radiance from the direction of each axis, and from the opposite one, without the dominant light.
    std::array<glm::vec3, kAxisCount> ahead{}, behind{};
    // All light, the dominant light included, in two bands of spherical harmonics: factors of 1, x, y, z.
    std::array<glm::vec3, 4> even{};
    // The dominant light, as a disc: what exceeds twice the mean luminance within 45 degrees of its middle.
    glm::vec3 dominantTowards{0, 1, 0}; // unit
    float dominantShare = 0.1f;         // sin^2 of its half angle
    glm::vec3 dominantRadiance{0};
};

// Reduces a lat-long map; a few hundred texels are enough. Changes smoothly with the map. Allocates nothing.
SmoothLight smoothLight(const ImageRgbF& radianceLin);

// Returns four directions that represent the dominant light.
glm::mat4x3 dominantDirections(const SmoothLight& light);

} // namespace shoal::occlusion
