// The plan of the glossy levels, and the level of detail of a roughness between them.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

// Roughness of the filtered levels: 10^(-i / kGlossySteps), i = 0 .. kGlossySteps. A step of 1.15: mixing two
// neighbours misses the lobe between them by a hundredth.
constexpr int kGlossySteps = 16;

constexpr float kMinFilteredRoughness = 0.1f;

enum class LightQuality {
    Video, // a fraction of a millisecond a frame, as accurate as 8 bits a channel need
    Still, // for environments made once, whose sun may be 10^5 times their shade: texels a quarter as wide
};

struct GlossyPlan {
    float roughness = 0;
    int width = 0;         // texels around
    bool filtered = false; // else the pyramid's own level k serves for plan k
};

// Ascending roughness; the last is 1.
//   First the pyramid's own levels from baseWidth (a power of two >= 256) down to 512, for mirrors: with the
// roughness that their texels amount to.
//   Then filtered levels, from the last that is not above minRoughness (the least that any surface has; at
// least 0.1) to 1, each as wide as its lobe needs, and no wider than baseWidth.
std::vector<GlossyPlan> glossyPlans(int baseWidth, float minRoughness, LightQuality quality);

// Level of detail for a roughness, 0 to levels.size() - 1: linear in 1 / alpha = 1 / roughness^2 between two
// levels. Of the variables tried (powers of alpha from 1 to -2, its logarithm) that one mixes two lobes into
// the nearest likeness of the one between. Twin of glossyLod() in shaders/light/Environment.glsl.
float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness);

// Level k's picture, wherever it lies.
const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k);

} // namespace shoal::light
