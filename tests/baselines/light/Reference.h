// The truth to measure the rest against: integrals over every texel of the environment at full resolution, in
// double precision, with exact solid angles. Written to be read; a direction takes milliseconds.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/Brdf.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace shoal::light {

// How light is weighed by its angle from the axis: math::ggxMirrorLobe, 0 beyond 90 degrees.
struct Lobe {
    double alpha = 1; // 1: the clamped cosine, over pi

    double operator()(double cosine) const { return math::ggxMirrorLobe(cosine, alpha); }
};

inline Lobe diffuseLobe() { return {1}; }
inline Lobe glossyLobe(double roughness) { return {math::alphaFromRoughness(roughness)}; } // roughness > 0

// For each lobe: integral of radiance times lobe over the sphere, over the integral of the lobe. The texel's
// centre stands for all of it, so lobes should be wider than texels. axis: unit length, env frame.
std::vector<glm::dvec3> referenceRadiance(const ImageRgbF& radianceLin, const glm::dvec3& axis,
                                          std::span<const Lobe> lobes);

} // namespace shoal::light
