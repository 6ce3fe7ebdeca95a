// The thesis' glossy lookup (its section 4.1) as reference maths: 36 samples of the radiance pyramid around
// the mirror direction. Twin of shaders/light/PhongRings.glsl.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec3.hpp>

#include <array>

namespace shoal::light {

struct PhongRing {
    double angle = 0;  // angle between its six samples and the mirror direction, radians, in (0, pi / 2)
    double weight = 0; // weight of all six samples together; the rings' weights sum to 1
};

constexpr int kPhongRings = 6;
constexpr int kSamplesPerRing = 6;

// Returns rings by ascending angle: three inside the cone at whose edge the lobe is half its peak, and three
// outside. Each ring represents a third of the energy inside or outside, and lies at the median of its part.
// The exponent is phongExponentFromRoughness().
std::array<PhongRing, kPhongRings> phongRings(double roughness);

// Returns the radiance; each ring is sampled in the level whose texels are as far apart as its samples.
glm::vec3 phongRingsRadiance(const RadiancePyramid& pyramid, const glm::vec3& mirror, double roughness);

} // namespace shoal::light
