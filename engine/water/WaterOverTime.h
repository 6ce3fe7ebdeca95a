// From the estimates of single frames to water that changes as smoothly as water does.
#pragma once

#include "engine/water/EstimateWater.h"

namespace shoal::water {

// A function of the estimates shown and of the times between them alone.
class WaterOverTime {
  public:
    // The estimate of the frame now shown; dt_s: since the last call. strength: 0 none of it, 1 all of it.
    // The first is taken as it is; later the veil and the strength are nine tenths there after a second (the
    // light changes as the camera moves), the attenuation after nine (the sea stays the sea).
    void follow(const WaterEstimate& estimate, float strength, float dt_s);

    Water water() const;

  private:
    bool begun_ = false;
    float strength_ = 0;
    std::array<glm::vec3, kVeilTerms> veil_{};
    glm::vec3 logAttenuation_{0};
};

} // namespace shoal::water
