// Which glossy levels there are, how each is made, and where between them a roughness lies.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

struct GlossyPlan {
    float roughness = 0;
    int width = 0; // texels around; level k of the pyramid is as wide
    int sourceWidth =
        0; // of the pyramid level filtered for it, width or twice that; 0: the pyramid's own level serves
};

// baseWidth: of pyramid level 0, a power of two >= 256. The first plan is the mirror, the last is 32 wide
// with roughness 1. A level's width decides its roughness, so that all surrounds share one table: 0.6 at 64,
// 0.35 at 128, 0.2 at 256, 0.1 at 512, and half at each doubling from there. Above 512 lobes are as narrow as
// texels, and the pyramid's own levels serve; the mirror gets the roughness that its texels amount to.
std::vector<GlossyPlan> videoLevels(int baseWidth); // a few milliseconds a frame
std::vector<GlossyPlan>
stillLevels(int baseWidth); // from twice the resolution where that can be had: twice as long

// Level of detail for a roughness, 0 to levels.size() - 1: linear in 1 / alpha = 1 / roughness^2 between two
// levels. Of the variables tried (powers of alpha from 1 to -2, its logarithm) that one mixes two lobes into
// the nearest likeness of the one between: root mean square difference of 7 % at 0.8 between 0.6 and 1, where
// alpha itself leaves 19 %. Twin of glossyLod() in shaders/light/Environment.glsl.
float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness);

// Level k's picture, wherever it lies.
const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k);

} // namespace shoal::light
