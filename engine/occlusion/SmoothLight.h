// An environment map reduced to what soft occlusion needs: one dominant light, and the radiance from a few
// directions.
#pragma once

#include "engine/core/Image.h"

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace shoal::occlusion {

inline constexpr size_t kAxisCount = 24;
// Unit vectors; these and their opposites are spread evenly over the sphere. shaders/occlusion/Axes.glsl.
extern const std::array<glm::vec3, kAxisCount> kAxes;

// In the frame of the map that it is made of, whose directions the axes are.
struct SmoothLight {
    // Radiance without the dominant light from along each axis, and from its other end.
    std::array<glm::vec3, kAxisCount> ahead{}, behind{};
    // All light on spherical harmonics of two bands: factors of 1, x, y, z.
    std::array<glm::vec3, 4> even{};
    // A round dominant light: what is brighter than a few times the mean, about where that is brightest.
    glm::vec3 dominantTowards{0, 1, 0}; // unit
    float dominantShare = 0.1f;         // sin^2 of its half angle
    glm::vec3 dominantRadiance{0};
};

// Of a lat-long map; a few hundred texels will do. Changes smoothly with the map. Allocates nothing.
SmoothLight smoothLight(const ImageRgbF& radianceLin);

// Four directions that share the dominant light among them.
glm::mat4x3 dominantDirections(const SmoothLight& light);

} // namespace shoal::occlusion
