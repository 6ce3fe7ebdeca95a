// From the radiance pyramid to what surfaces see: the diffuse map and every glossy level.
#pragma once

#include "engine/light/CentroidChain.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/GlossyLevels.h"
#include "engine/light/ZonalFilter.h"

#include <vector>

namespace shoal::light {

class LightFilters {
  public:
    LightFilters(int baseWidth, float minRoughness, LightQuality quality);

    // out.radiance holds the pyramid. Fills diffuse and glossy. One thread at a time.
    void make(EnvironmentLight& out);

    int baseWidth() const { return plans_[0].width; }

  private:
    std::vector<GlossyPlan> plans_;
    CentroidChain chain_;
    std::vector<ZonalFilter> filters_; // narrow lobes on wide maps first; the last makes the diffuse map too
    std::vector<ImageRgbF*> targets_;
};

} // namespace shoal::light
