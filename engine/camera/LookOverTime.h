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

    FilmLook look() const; // before the first: none

  private:
    bool begun_ = false, edgesSeen_ = false, chromaSeen_ = false;
    FilmLook look_;
    glm::vec2 chromaTexels_{2};
};

} // namespace shoal::camera
