#include "engine/light/GlossyLevels.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace shoal::light {

namespace {

constexpr int kNarrowestMirror = 512;
// Widths of the filtered levels.
struct Widths {
    int minimum, maximum;
    int matte;            // for roughness 1: the clamped cosine has a kink, which a strong sun makes visible
    double texelsPerLobe; // minimum of alpha times width
};

constexpr Widths widthsOf(LightQuality quality) {
    return quality == LightQuality::Video ? Widths{64, 512, 64, 7.0} : Widths{256, 1024, 512, 10.0};
}

int widthFor(double roughness, int baseWidth, const Widths& widths) {
    if (roughness == 1) return std::min(widths.matte, baseWidth);
    int width = widths.minimum;
    while (width < std::min(widths.maximum, baseWidth) &&
           roughness * roughness * width < widths.texelsPerLobe)
        width *= 2;
    return width;
}

// Returns the roughness whose lobe is a texel wide: half a lobe is within 2 alpha, a texel within pi / width.
float roughnessOfTexel(int width) { return std::sqrt(2.5f / static_cast<float>(width)); }

} // namespace

std::vector<GlossyPlan> glossyPlans(int baseWidth, float minRoughness, LightQuality quality) {
    assert(baseWidth >= 256 && std::has_single_bit(static_cast<unsigned>(baseWidth)));
    std::vector<GlossyPlan> plans;
    for (int width = baseWidth; width == baseWidth || width >= kNarrowestMirror; width /= 2)
        plans.push_back({std::min(roughnessOfTexel(width), 0.099f), width, false});
    const double minimum = static_cast<double>(std::clamp(minRoughness, kMinFilteredRoughness, 1.0f));
    const int first =
        std::min(kGlossySteps, static_cast<int>(std::ceil(-std::log10(minimum) * kGlossySteps - 1e-6)));
    for (int i = first; i >= 0; --i) {
        const double roughness = std::pow(10.0, -static_cast<double>(i) / kGlossySteps);
        plans.push_back(
            {static_cast<float>(roughness), widthFor(roughness, baseWidth, widthsOf(quality)), true});
    }
    return plans;
}

float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness) {
    constexpr float kMin = 1e-6f;
    const float alpha = std::max(roughness * roughness, kMin);
    float lod = 0;
    for (size_t k = 0; k + 1 < levels.size(); ++k) {
        const float low = std::max(levels[k].roughness * levels[k].roughness, kMin);
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
