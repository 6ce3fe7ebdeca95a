// Samples a lat-long map on the CPU as a graphics card does: linear between texel centres, wrapping in u, and
// over the poles. For tests, tools and reference maths.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec3.hpp>

namespace shoal::light {

// dir: unit length, env frame.
glm::vec3 lookUp(const ImageRgbF& map, const glm::vec3& dir);

// Trilinear; lod is clamped to the pyramid.
glm::vec3 lookUp(const RadiancePyramid& pyramid, const glm::vec3& dir, float lod);

// Trilinear between the glossy levels, twin of glossyRadiance() in shaders/light/Environment.glsl.
glm::vec3 lookUpGlossy(const EnvironmentLight& light, const glm::vec3& dir, float roughness);

} // namespace shoal::light
