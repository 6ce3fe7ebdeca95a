// Radiance filtered by GGX lobes: the levels of EnvironmentLight::glossy from the radiance pyramid.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/light/GlossyLevels.h"
#include "engine/light/ZonalFilter.h"

#include <optional>
#include <vector>

namespace shoal::light {

class GlossyPrefilter {
  public:
    // Makes the filters: about a second and 10 MB for levels up to 512 wide.
    explicit GlossyPrefilter(std::vector<GlossyPlan> plans);

    // Fills all levels of out. Those which the pyramid serves stay empty, see EnvironmentLight. One thread at
    // a time.
    void make(const RadiancePyramid& pyramid, std::vector<GlossyLevel>& out);

    const std::vector<GlossyPlan>& plans() const { return plans_; }

  private:
    std::vector<GlossyPlan> plans_;
    std::vector<std::optional<ZonalFilter>> zonal_; // one for each plan
    ImageRgbF wide_;                                // a level before it is halved to its width
};

} // namespace shoal::light
