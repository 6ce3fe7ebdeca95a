#include "engine/light/GlossyLevels.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace shoal::light {

namespace {

constexpr int kNarrowest = 32;
constexpr int kWidestFiltered = 512; // above, lobes are as narrow as texels
constexpr int kLeastSource = 64;     // 32 texels around are too few to be summed, though enough to be shown

float roughnessOfWidth(int width) {
    switch (width) {
    case 32:
        return 1.0f;
    case 64:
        return 0.6f;
    case 128:
        return 0.35f;
    case 256:
        return 0.2f;
    default:
        return 0.1f * 512.0f / static_cast<float>(width);
    }
}

std::vector<GlossyPlan> levels(int baseWidth, bool fromTwice) {
    assert(baseWidth >= 2 * kNarrowest && std::has_single_bit(static_cast<unsigned>(baseWidth)));
    std::vector<GlossyPlan> plans;
    for (int width = baseWidth; width >= kNarrowest; width /= 2) {
        GlossyPlan plan{roughnessOfWidth(width), width, 0};
        if (width < baseWidth && width <= kWidestFiltered) {
            const bool twice = fromTwice && width < kWidestFiltered;
            plan.sourceWidth = std::max(twice ? 2 * width : width, kLeastSource);
        }
        plans.push_back(plan);
    }
    // Half a lobe's light lies within 2 alpha of its peak, a texel reaches pi / width from its centre.
    plans[0].roughness = std::min(std::sqrt(2.5f / static_cast<float>(baseWidth)), 0.5f * plans[1].roughness);
    return plans;
}

} // namespace

std::vector<GlossyPlan> videoLevels(int baseWidth) { return levels(baseWidth, false); }
std::vector<GlossyPlan> stillLevels(int baseWidth) { return levels(baseWidth, true); }

float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness) {
    constexpr float kLeast = 1e-6f;
    const float alpha = std::max(roughness * roughness, kLeast);
    float lod = 0;
    for (size_t k = 0; k + 1 < levels.size(); ++k) {
        const float low = std::max(levels[k].roughness * levels[k].roughness, kLeast);
        const float high = levels[k + 1].roughness * levels[k + 1].roughness;
        lod += std::clamp((alpha - low) * high / (alpha * (high - low)), 0.0f, 1.0f);
    }
    return lod;
}

const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k) {
    const ImageRgbF& own = light.glossy[k].radianceLin;
    return own.empty() ? light.radiance.levels[k] : own;
}

} // namespace shoal::light
