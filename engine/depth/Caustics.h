// Light that waves focus, as the film's ground shows it: a ground point's present brightness divided by its
// recent mean. The sun's rays that meet an animal meet the ground a little further on, where the film shows
// how bright they are.
//
// The pattern changes with depth: in our reef the light at two points of one ray correlates by 0.86 if they
// are 1 m apart, and by 0.52 if they are 3 m apart. tests/bench/figures/bounce.md has what remains of it.
#pragma once

#include "engine/core/Image.h"
#include "engine/depth/DepthMap.h"

#include <glm/vec3.hpp>

namespace shoal::depth {

class Caustics {
  public:
    // Takes the next frame that is shown. radianceLin: lat-long, about 64 texels around; finer maps err more,
    // because distances are too rough for them. passed_s: since the frame before. The mean follows with a
    // time constant of half a second, and begins anew with another size, or after a longer time or a step
    // back. Allocates only on the first call.
    void follow(const ImageRgbF& radianceLin, float passed_s);

    // Returns the change of the ground's light, as a share of its mean, where the light's ray through a place
    // meets the ground; averaged over a body of this length. 0 if no ground is known within 3 m. map: of the
    // same frame. env frame, metres from the film's camera; towardsEnv: unit length, towards the light.
    float changeAt(const glm::vec3& placeEnv, const glm::vec3& towardsEnv, float length_m,
                   const DepthMap& map) const;

  private:
    ImageF mean_, change_; // of the frames' luminance
};

} // namespace shoal::depth
