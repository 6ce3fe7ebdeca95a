// The thesis' glossy lookup (its section 4.1) as reference maths: 36 samples of the radiance pyramid around
// the mirror direction. Twin of shaders/light/PhongRings.glsl.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec3.hpp>

#include <array>

namespace shoal::light {

struct PhongRing {
    double angle = 0;  // between its six samples and the mirror direction, radians, in (0, pi / 2)
    double weight = 0; // of all six together; the rings' weights sum to 1
};

constexpr int kPhongRings = 6;
constexpr int kSamplesPerRing = 6;

// Three rings inside the cone where the lobe falls to half its peak, three outside, ascending. Inside and
// outside each ring stands for an equal part of the lobe's energy and lies where that part has its median.
// The exponent is phongExponentFromRoughness().
std::array<PhongRing, kPhongRings> phongRings(double roughness);

// Looks the light up; every ring is read from the level whose texels are as far apart as its samples.
glm::vec3 phongRingsRadiance(const RadiancePyramid& pyramid, const glm::vec3& mirror, double roughness);

} // namespace shoal::light
