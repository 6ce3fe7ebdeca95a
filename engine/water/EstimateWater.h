// What one frame of a 360-degree video says about the water that it was filmed in.
#pragma once

#include "engine/light/FrameView.h"
#include "engine/water/FitAttenuation.h"
#include "engine/water/Water.h"

#include <array>
#include <optional>
#include <vector>

namespace shoal::water {

struct WaterEstimate {
    Water water;        // as if the surround were under water
    float evidence = 0; // that it is, 0 to 1: water takes red first, so the horizon has lost it all around
};

// Keeps its scratch between frames: nothing is allocated after the first. One thread at a time.
//
// Coded values are taken back to the scene's light by sRGB's curve. Then
//   - the veil: a smooth function of direction (bands 0 to 2) below the light of the surround, since the veil
//     is part of whatever is seen and is all of it where the water is deep. Fitted to means over cells by
//     least squares that give up what is brighter, as the dark channel takes minima over patches (He, Sun and
//     Tang 2009; under water Drews et al. 2013). What looks up through the surface is left out: there it is
//     the sky that is seen.
//   - the attenuation: from how the floor fades into the veil with distance, height / sine of the angle below
//     the horizon (fitAttenuation()); medians over those sectors of the horizon where green or blue exceed
//     red the most, which is where the water is deepest, so that rocks do not count as floor.
class WaterEstimator {
  public:
    // eyeHeight_m: above the floor; without it no distance is known, and the attenuation is the prior's.
    explicit WaterEstimator(std::optional<float> eyeHeight_m) : eyeHeight_m_(eyeHeight_m) {}

    WaterEstimate estimate(const light::FrameView& frame);

  private:
    void sample(const light::FrameView& frame);
    glm::vec3 meanLin(int sector, int firstRow, int lastRow) const; // rows first .. last - 1
    float redIsLost(int firstRow, int lastRow) const;
    void sortSectors(int firstRow, int lastRow);
    glm::vec3 across(int sectors, int firstRow, int lastRow) const; // median of the most open sectors' means

    static constexpr int kSectors = 16, kOpenSectors = 6; // of the horizon

    std::optional<float> eyeHeight_m_;
    std::array<int, kSectors> openFirst_{};
    std::vector<glm::vec3> cellsLin_; // of each row, the sectors' means of the scene's light
    std::vector<FloorSample> floor_;
};

} // namespace shoal::water
