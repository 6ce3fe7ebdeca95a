// Temporal smoothing of water estimates.
#pragma once

#include "engine/water/EstimateWater.h"

namespace shoal::water {

// Deterministic: depends only on the estimates and the times between them.
class WaterOverTime {
  public:
    // The estimate of the frame now shown; dt_s: since the last call. strength: 0 none of it, 1 all of it.
    // The first is taken as it is; later the veil and the strength have a time constant of 0.43 s (the light
    // changes as the camera moves), the attenuation of 4 s (the water stays the same).
    void follow(const WaterEstimate& estimate, float strength, float dt_s);

    Water water() const;

  private:
    bool begun_ = false;
    float strength_ = 0;
    std::array<glm::vec3, kVeilTerms> veil_{};
    glm::vec3 logAttenuation_{0};
};

} // namespace shoal::water
