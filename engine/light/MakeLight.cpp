#include "engine/light/MakeLight.h"

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

void LightMaker::make(const FrameView& frame, EnvironmentLight& out) {
    pyramid_.make(frame, options_.baseWidth, out.radiance, options_.frames);
    filter(out);
}

void LightMaker::makeFromHdr(const ImageRgbF& radianceLin, EnvironmentLight& out) {
    pyramid_.make(radianceLin, options_.baseWidth, out.radiance);
    filter(out);
}

void LightMaker::makeFilters(int baseWidth) {
    filters_.emplace(glossyPlans(baseWidth, options_.minRoughness, options_.quality),
                     CentroidChain(baseWidth), std::vector<ZonalFilter>());
    const std::vector<GlossyPlan>& plans = filters_->plans;
    std::vector<double> alphas;
    for (size_t k = 0; k < plans.size(); ++k) {
        if (!plans[k].filtered) continue;
        const double roughness = static_cast<double>(plans[k].roughness);
        alphas.push_back(roughness * roughness);
        if (k + 1 < plans.size() && plans[k + 1].width == plans[k].width) continue;
        filters_->filters.emplace_back(filters_->chain.sampling(plans[k].width), alphas);
        alphas.clear();
    }
}

// Makes the diffuse map and every glossy level from the radiance pyramid.
void LightMaker::filter(EnvironmentLight& out) {
    const int baseWidth = out.radiance.levels[0].width;
    if (!filters_ || filters_->plans[0].width != baseWidth) makeFilters(baseWidth);
    auto& [plans, chain, filters] = *filters_;
    chain.make(out.radiance.levels[0]);
    out.glossy.resize(plans.size());
    std::span<GlossyLevel> rest(out.glossy);
    for (size_t k = 0; k < plans.size(); ++k) {
        out.glossy[k].roughness = plans[k].roughness;
        if (plans[k].filtered) continue;
        out.glossy[k].radianceLin = ImageRgbF();
        rest = rest.subspan(1);
    }
    for (ZonalFilter& filter : filters) {
        filter.apply(chain.level(filter.width()), rest.first(filter.lobes()));
        rest = rest.subspan(filter.lobes());
    }
    // A lobe of alpha 1 is that of a matte surface.
    out.diffuse = out.glossy.back().radianceLin;
}

} // namespace shoal::light
