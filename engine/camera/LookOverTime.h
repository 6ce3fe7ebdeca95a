// From the estimates of single frames to a look that nobody sees changing.
#pragma once

#include "engine/camera/EstimateLook.h"

namespace shoal::camera {

// A function of the estimates shown and of the times between them alone.
class LookOverTime {
  public:
    // The estimate of the frame now shown; dt_s: since the last call. The first is taken as it is; later all
    // is nine tenths there after five seconds: cameras are not changed in mid-dive. What an estimate does not
    // know stays.
    void follow(const LookEstimate& estimate, float dt_s);

    // No frame's lens scatters more than this share of the light (Glow.h): the least of all frames is
    // believed. While that says little, the lens is taken to be as others are.
    void followGlare(float mostShare, float dt_s);

    FilmLook look() const; // before the first: none

  private:
    float mostGlare_ = 1;
    bool glareSeen_ = false;
    bool begun_ = false, edgesSeen_ = false, chromaSeen_ = false;
    FilmLook look_;
    glm::vec2 chromaTexels_{2};
};

} // namespace shoal::camera
