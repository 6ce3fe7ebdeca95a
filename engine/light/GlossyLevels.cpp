#include "engine/light/GlossyLevels.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace shoal::light {

namespace {

constexpr int kNarrowest = 32;

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

int videoCells(int width) {
    switch (width) {
    case 32:
        return 256;
    case 64:
        return 192;
    case 128:
        return 96;
    case 256:
        return 64;
    default:
        return 40;
    }
}

template <class Refine> std::vector<GlossyPlan> levels(int baseWidth, Refine refine) {
    assert(baseWidth >= 2 * kNarrowest && std::has_single_bit(static_cast<unsigned>(baseWidth)));
    std::vector<GlossyPlan> plans{{0.0f, baseWidth, 0, 0}};
    for (int width = baseWidth / 2; width >= kNarrowest; width /= 2) {
        GlossyPlan plan{roughnessOfWidth(width), width, 0, 0};
        refine(plan);
        plans.push_back(plan);
    }
    return plans;
}

} // namespace

std::vector<GlossyPlan> videoLevels(int baseWidth) {
    return levels(baseWidth, [](GlossyPlan& plan) {
        plan.cells = videoCells(plan.width);
        plan.finestWidth = plan.width;
    });
}

std::vector<GlossyPlan> stillLevels(int baseWidth) {
    return levels(baseWidth, [](GlossyPlan& plan) {
        plan.cells = plan.width >= 512 ? 256 : 1024;
        plan.finestWidth = plan.width * 2;
    });
}

float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness) {
    const float alpha = roughness * roughness;
    float lod = 0;
    for (size_t k = 0; k + 1 < levels.size(); ++k) {
        const float low = levels[k].roughness * levels[k].roughness;
        const float high = levels[k + 1].roughness * levels[k + 1].roughness;
        lod += std::clamp((alpha - low) / (high - low), 0.0f, 1.0f);
    }
    return lod;
}

const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k) {
    return k == 0 ? light.radiance.levels[0] : light.glossy[k].radianceLin;
}

} // namespace shoal::light
