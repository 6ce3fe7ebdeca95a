// Difference of the light at a place from that at the film's camera: near a sunlit rock it has the rock's
// colour, in a cave's mouth there is less of the light outside. Rays are marched from the place to the first
// surface that the film shows, as in parallax-corrected cube maps (Lagarde and Zanuttini 2012, "Local
// Image-based Lighting With Parallax-corrected Cubemaps") with the film's distances in place of a box. env
// frame, metres from the film's camera.
#pragma once

#include "engine/core/Image.h"
#include "engine/depth/DepthMap.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::depth {

// Harmonics of radiance, bands 0 to 2, in the order of math::shBasis().
using LightHarmonics = std::array<glm::vec3, 9>;

class LightDifference {
  public:
    // Surfaces beyond kFar_m count as infinitely far, those from half of it on in part. At places beyond it
    // the difference fades; from 1.5 times it on there is none.
    static constexpr float kFar_m = 4;

    // radianceLin: lat-long, about 64 texels around, of the frame that the map belongs to. Allocates only on
    // the first call.
    void make(const ImageRgbF& radianceLin, const DepthMap& map);

    // Returns the radiance at the place minus that at the camera; exactly 0 if its rays all go to infinity.
    LightHarmonics at(const glm::vec3& placeEnv) const;

  private:
    int firstMet(const glm::vec3& place, const glm::vec3& dir) const; // index of a fine cell; -1: none

    std::vector<float> inverse_perM_; // by fine cell
    std::vector<glm::vec3> radiance_; // by coarse cell
};

} // namespace shoal::depth
