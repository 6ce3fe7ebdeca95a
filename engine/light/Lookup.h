// Samples a lat-long map on the CPU as a graphics card does: linear between texel centres, wrapping in u, and
// over the poles. For tests, tools and reference maths.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec3.hpp>

#include <array>

namespace shoal::light {

// dir: unit length, env frame.
glm::vec3 lookUp(const ImageRgbF& map, const glm::vec3& dir);

// Trilinear; lod is clamped to the pyramid.
glm::vec3 lookUp(const RadiancePyramid& pyramid, const glm::vec3& dir, float lod);

// Returns the level of detail for a roughness, 0 to levels.size() - 1. It is linear in 1 / alpha = 1 /
// roughness^2 between two levels: among powers of alpha from 1 to -2 and its logarithm, this one makes the
// mix of two lobes nearest to the lobe between. Twin of mirrorLod() in shaders/light/Environment.glsl.
float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness);

// Returns the map of level k: its own, or the radiance pyramid's level.
const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k);

// Trilinear between the glossy levels, twin of glossyRadiance() in shaders/light/Environment.glsl.
glm::vec3 lookUpGlossy(const EnvironmentLight& light, const glm::vec3& dir, float roughness);

// --- The thesis' glossy lookup (its section 4.1): 36 samples of the radiance pyramid around the mirror
// direction. Twin of shaders/light/PhongRings.glsl.

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
