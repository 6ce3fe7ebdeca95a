// The plan of the glossy levels, and the level of detail of a roughness between them.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

// Roughness of the filtered levels: 10^(-i / kGlossySteps), i = 0 .. kGlossySteps. Neighbours differ by a
// factor of 1.15: a mix of two differs from the lobe between them by a hundredth.
constexpr int kGlossySteps = 16;

constexpr float kMinFilteredRoughness = 0.1f;

enum class LightQuality {
    Video, // a fraction of a millisecond a frame, as accurate as 8 bits a channel need
    Still, // for stills, whose sun may be 10^5 times as bright as the shade: texels a quarter as wide
};

struct GlossyPlan {
    float roughness = 0;
    int width = 0;         // texels around
    bool filtered = false; // if false, the radiance pyramid's level k is used for plan k
};

// Returns the plans of all levels by ascending roughness; the last has roughness 1.
//   The first plans are levels of the radiance pyramid, for mirrors: from baseWidth (a power of two >= 256)
// down to a width of 512, with the roughness of a lobe as wide as their texels.
//   The others are filtered levels, from the greatest roughness not above minRoughness (the least of all
// surfaces; raised to 0.1) to 1, each as wide as its lobe needs, and no wider than baseWidth.
std::vector<GlossyPlan> glossyPlans(int baseWidth, float minRoughness, LightQuality quality);

// Returns the level of detail for a roughness, 0 to levels.size() - 1. It is linear in 1 / alpha = 1 /
// roughness^2 between two levels: among powers of alpha from 1 to -2 and its logarithm, this one makes the
// mix of two lobes nearest to the lobe between. Twin of glossyLod() in shaders/light/Environment.glsl.
float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness);

// Returns the map of level k: its own, or the radiance pyramid's level.
const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k);

} // namespace shoal::light
