// Which glossy levels there are, how finely each is made, and where between them a roughness lies.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

struct GlossyPlan {
    float roughness = 0;
    int width = 0;       // texels around; widths halve from level to level
    int cells = 0;       // pyramid texels summed for one texel of the level; 0 for the mirror
    int finestWidth = 0; // widest pyramid level they are taken from
};

// baseWidth: of pyramid level 0, a power of two >= 256. The first plan is the mirror, which is that level
// itself; the last is 32 wide with roughness 1. A level's width decides its roughness, so that all surrounds
// share one table: 0.6 at 64, 0.35 at 128, 0.2 at 256, 0.1 at 512, and half at each doubling from there.
std::vector<GlossyPlan> videoLevels(int baseWidth); // some milliseconds for 1024
std::vector<GlossyPlan> stillLevels(int baseWidth); // a second or two; nearly the integral

// Level of detail for a roughness, 0 to levels.size() - 1: linear in alpha = roughness^2 between two levels,
// as a lobe's width goes with alpha. Twin of glossyLod() in shaders/light/Environment.glsl.
float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness);

// Level k's picture; level 0 lies in the pyramid.
const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k);

} // namespace shoal::light
