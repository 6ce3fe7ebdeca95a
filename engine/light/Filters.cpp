#include "engine/light/Filters.h"

#include <cassert>

namespace shoal::light {

LightFilters::LightFilters(int baseWidth, float minRoughness, LightQuality quality)
    : plans_(glossyPlans(baseWidth, minRoughness, quality)), chain_(baseWidth, 64) {
    std::vector<double> alphas;
    for (size_t k = 0; k < plans_.size(); ++k) {
        if (!plans_[k].filtered) continue;
        const double roughness = static_cast<double>(plans_[k].roughness);
        alphas.push_back(roughness * roughness);
        const bool last = k + 1 == plans_.size() || plans_[k + 1].width != plans_[k].width;
        if (last) filters_.emplace_back(chain_.sampling(plans_[k].width), alphas);
        if (last) alphas.clear();
    }
}

void LightFilters::make(EnvironmentLight& out) {
    chain_.make(out.radiance.levels[0]);
    out.glossy.resize(plans_.size());
    auto filter = filters_.begin();
    targets_.clear();
    for (size_t k = 0; k < plans_.size(); ++k) {
        out.glossy[k].roughness = plans_[k].roughness;
        if (!plans_[k].filtered) {
            out.glossy[k].radianceLin = ImageRgbF();
            continue;
        }
        targets_.push_back(&out.glossy[k].radianceLin);
        if (k + 1 < plans_.size() && plans_[k + 1].width == plans_[k].width) continue;
        filter->apply(chain_.level(filter->width()), targets_);
        ++filter;
        targets_.clear();
    }
    // A lobe of alpha 1 is a matte surface's.
    out.diffuse = out.glossy.back().radianceLin;
}

} // namespace shoal::light
