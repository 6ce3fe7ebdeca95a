// Computes how the light at a place differs from the light at the film's camera: a sunlit rock nearby adds
// its colour, a cave's mouth takes away light from outside. Marches rays from the place to the first surface
// that the film shows, as in parallax-corrected cube maps (Lagarde and Zanuttini 2012, "Local Image-based
// Lighting With Parallax-corrected Cubemaps") with the film's distances in place of a box. Places are in the
// env frame, metres from the film's camera.
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
    // A surface's effect fades from kFar_m / 2 to kFar_m; farther ones count as infinitely far. The
    // difference at a place fades from kFar_m to 1.5 kFar_m from the camera.
    static constexpr float kFar_m = 4;

    // radianceLin: lat-long map of the same frame, about 64 texels wide. Allocates only on the first call.
    void make(const ImageRgbF& radianceLin, const DepthMap& map);

    // Returns the radiance at the place minus that at the camera; exactly 0 if no ray hits a surface.
    LightHarmonics at(const glm::vec3& placeEnv) const;

  private:
    int firstHit(const glm::vec3& place, const glm::vec3& dir) const; // fine cell that the ray hits; -1: none

    std::vector<float> inverse_perM_; // inverse distance from the camera, by fine cell
    std::vector<glm::vec3> radiance_; // mean, by coarse cell
};

} // namespace shoal::depth
