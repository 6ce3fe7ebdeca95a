// Model of the water between eye and object: attenuation of the object's light, and the veil (backscatter)
// that is added; and its estimate from the frames of a 360-degree video. Twin of shaders/render/Water.glsl;
// free of OpenGL.
//
// I = J exp(-beta d) + B (1 - exp(-beta d)), for each channel: Schechner and Karpel 2005, "Recovery of
// Underwater Visibility and Structure by Polarization Analysis", with one beta for both terms; its limits:
// Akkaynak and Treibitz 2018, "A Revised Underwater Image Formation Model" (beta depends on distance and
// object, at the few metres of a dive by some tens of percent).
//
// The equation is linear in the scene's light. Neither coded values nor the radiance after inverse tone
// mapping are (the latter is about 1.8 times the coded value where that is low, far more where it is high).
// So water works on the squares of display values, which approximate the sRGB curve without powers.
#pragma once

#include "engine/light/FrameView.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace shoal::water {

// Returns the real spherical harmonics of bands 0 to 2 without their constant factors. Twin of
// shaders/render/Water.glsl.
constexpr size_t kVeilTerms = 9;
inline std::array<float, kVeilTerms> veilTerms(const glm::vec3& dir) {
    const glm::vec3 square = dir * dir, mixed = dir * glm::vec3(dir.y, dir.z, dir.x); // xy, yz, zx
    return {1, dir.x, dir.y, dir.z, mixed.x, mixed.y, mixed.z, square.y - 1 / 3.0f, square.x - square.z};
}

struct Water {
    // Light of infinitely deep water: coefficients of veilTerms(), in squared coded values by direction.
    std::array<glm::vec3, kVeilTerms> veil{};
    glm::vec3 attenuation_perM{0}; // beta, by red, green and blue; 0: no water

    bool none() const { return attenuation_perM.x + attenuation_perM.y + attenuation_perM.z < 1e-3f; }
};

// --- Estimate

struct WaterEstimate {
    Water water;        // valid if the environment is under water
    float evidence = 0; // 0 to 1: rises with the share of horizon that lost red, which water absorbs first
};

// Does not allocate after the first frame. One thread at a time.
//
// Coded values are linearised by the sRGB curve. Then
//   - the veil (backscatter): spherical harmonics of bands 0 to 2, fitted as a lower envelope to means over
//     cells by robust least squares, since the veil is part of every pixel and all of it where the water is
//     deep. It corresponds to the dark channel's minima over patches (He, Sun and Tang 2009; under water
//     Drews et al. 2013). Directions through the surface to the sky are left out.
//   - the attenuation: from the veil's colour at the horizon (attenuationFromVeil()); medians over those
//     sectors of the horizon where green or blue exceed red the most, which is where the water is deepest.
class WaterEstimator {
  public:
    WaterEstimate estimate(const light::FrameView& frame);

  private:
    std::vector<glm::vec3> cellsLin_; // by row: mean light of the scene in each sector of the horizon
};

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
