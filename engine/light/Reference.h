// The truth to measure the rest against: integrals over every texel of the surround at full resolution, in
// double precision, with exact solid angles. Written to be read; a direction takes milliseconds.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace shoal::light {

// Weight of light from a direction at this cosine from the axis; any scale.
using Lobe = std::function<double(double cosine)>;

Lobe diffuseLobe();                // max(0, cosine)
Lobe glossyLobe(double roughness); // math::ggxMirrorLobe; roughness > 0

// For each lobe: integral of radiance times lobe over the sphere, over the integral of the lobe. The texel's
// centre stands for all of it, so lobes should be wider than texels. axis: unit length, env frame.
std::vector<glm::dvec3> referenceRadiance(const ImageRgbF& radianceLin, const glm::dvec3& axis,
                                          std::span<const Lobe> lobes);

} // namespace shoal::light
