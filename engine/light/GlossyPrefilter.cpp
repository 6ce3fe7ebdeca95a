#include "engine/light/GlossyPrefilter.h"

#include <cassert>

namespace shoal::light {

GlossyPrefilter::GlossyPrefilter(std::vector<GlossyPlan> plans)
    : plans_(std::move(plans)), zonal_(plans_.size()) {
    for (size_t k = 0; k < plans_.size(); ++k)
        if (plans_[k].sourceWidth) {
            const double roughness = static_cast<double>(plans_[k].roughness);
            zonal_[k].emplace(plans_[k].sourceWidth, roughness * roughness);
        }
}

void GlossyPrefilter::make(const RadiancePyramid& pyramid, std::vector<GlossyLevel>& out) {
    assert(pyramid.levels[0].width == plans_[0].width);
    out.resize(plans_.size());
    for (size_t k = 0; k < plans_.size(); ++k) {
        const GlossyPlan& plan = plans_[k];
        ImageRgbF& image = out[k].radianceLin;
        out[k].roughness = plan.roughness;
        if (plan.sourceWidth)
            filterLevel(*zonal_[k], pyramid, plan.sourceWidth, plan.width, wide_, image);
        else
            image = ImageRgbF();
    }
}

} // namespace shoal::light
