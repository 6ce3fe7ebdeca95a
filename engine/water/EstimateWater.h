// The water of a 360-degree video, its veil and attenuation, is estimated from the video's frames.
#pragma once

#include "engine/light/FrameView.h"
#include "engine/water/Water.h"

namespace shoal::water {

struct WaterEstimate {
    Water water;        // valid if the environment is under water
    float evidence = 0; // 0 to 1: rises with the share of horizon that lost red and kept blue, as in water
};

// Estimates the water from one frame. Allocates nothing. Coded values are linearised by the sRGB curve. Then
//   - the veil (backscatter): spherical harmonics of bands 0 to 2, fitted as a lower envelope to means over
//     cells by robust least squares, since the veil is part of every pixel and all of it where the water is
//     deep. It corresponds to the dark channel's minima over patches (He, Sun and Tang 2009; under water
//     Drews et al. 2013). Directions through the surface to the sky are left out.
//   - the attenuation: from the veil's colour at the horizon (attenuationFromVeil()); medians over those
//     sectors of the horizon where green or blue exceed red the most, which is where the water is deepest.
WaterEstimate estimateWater(const light::FrameView& frame);

// Returns the attenuation per metre: clear coastal water's, with red attenuated most. The ratio of green to
// blue follows from the veil, which under single scattering is b E / beta, with b about equal for both. E,
// the light from above, has passed through water too: the veil is about proportional to 1 / beta^2. Its red
// is not used, because cameras' white balance compensates for it. veilLin: linear scene light at the horizon.
//
// On the reef film this is wrong by 2 % of the light at 1 to 3 m; fitting how its floor fades with distance
// is wrong by 10 %, because rocks and slopes count as floor.
glm::vec3 attenuationFromVeil(const glm::vec3& veilLin);

// Temporal smoothing of estimates. Deterministic: depends only on the estimates and the times between them.
class WaterOverTime {
  public:
    // Takes the estimate of the frame now shown; dt_s: since the last call. strength: 0 none of it, 1 all of
    // it. The first is used directly; later the veil and the strength have a time constant of 0.43 s (the
    // light changes as the camera moves), the attenuation of 4 s (the water stays the same).
    void follow(const WaterEstimate& estimate, float strength, float dt_s);

    Water water() const;

  private:
    bool begun_ = false;
    float strength_ = 0;
    std::array<glm::vec3, kVeilTerms> veil_{};
    glm::vec3 logAttenuation_{0};
};

} // namespace shoal::water
