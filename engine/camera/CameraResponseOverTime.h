// Temporal smoothing of camera response estimates.
#pragma once

#include "engine/camera/EstimateCameraResponse.h"

namespace shoal::camera {

// Deterministic: depends only on the estimates and the times between them.
class CameraResponseOverTime {
  public:
    // The estimate of the frame now shown; dt_s: since the last call. The first is taken as it is, later ones
    // with a time constant of 2.2 seconds: cameras are not changed in mid-dive. Unknown values stay.
    void follow(const CameraResponseEstimate& estimate, float dt_s);

    // Upper bound of the glare from one frame (Glare.h): the minimum of all frames counts. While no frame
    // gives a useful bound, a typical lens is assumed.
    void followGlare(float maxShare, float dt_s);

    CameraResponse response() const; // before the first estimate: without effect

  private:
    float maxGlare_ = 1;
    bool glareSeen_ = false;
    bool begun_ = false, edgesSeen_ = false, chromaSeen_ = false;
    CameraResponse response_;
    glm::vec2 chromaTexels_{2};
};

} // namespace shoal::camera
