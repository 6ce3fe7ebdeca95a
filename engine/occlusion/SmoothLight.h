// Light as the soft shadows of bodies need it: its brightest part, and nine colours for all the rest.
#pragma once

#include "engine/core/Image.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace shoal::occlusion {

struct SmoothLight {
    // Radiance by direction without the lamp, bands 0 to 2 as polynomials: factors of 1, x, y, z, xy, yz, xz,
    // y^2 - 1/3, x^2 - z^2.
    std::array<glm::vec3, 9> around{};
    // A round lamp: what is brighter than a few times the mean, about where that is brightest.
    glm::vec3 lampTowards{0, 1, 0}; // unit
    float lampShare = 0.1f;         // sin^2 of its half angle
    glm::vec3 lampRadiance{0};
};

// Of a lat-long map; a few hundred texels will do. Same frame. Changes smoothly with the map. Allocates
// nothing.
SmoothLight smoothLight(const ImageRgbF& radianceLin);

// The same light in another frame. thereFromHere: a rotation.
SmoothLight turned(const SmoothLight& light, const glm::mat3& thereFromHere);

} // namespace shoal::occlusion
