#include "engine/water/WaterOverTime.h"

#include <algorithm>

namespace shoal::water {

namespace {

constexpr float kVeil_s = 0.43f, kAttenuation_s = 4; // time constants

float share(float dt_s, float constant_s) { return 1 - std::exp(-std::max(dt_s, 0.0f) / constant_s); }

} // namespace

void WaterOverTime::follow(const WaterEstimate& estimate, float strength, float dt_s) {
    const float fast = begun_ ? share(dt_s, kVeil_s) : 1, slow = begun_ ? share(dt_s, kAttenuation_s) : 1;
    begun_ = true;
    strength_ += (strength - strength_) * fast;
    for (size_t i = 0; i < kVeilTerms; ++i) veil_[i] += (estimate.water.veil[i] - veil_[i]) * fast;
    logAttenuation_ += (glm::log(estimate.water.attenuation_perM) - logAttenuation_) * slow;
}

Water WaterOverTime::water() const {
    return {veil_, begun_ ? glm::exp(logAttenuation_) * strength_ : glm::vec3(0)};
}

} // namespace shoal::water
