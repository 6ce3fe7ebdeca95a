// Placement of the text panel in a headset: in front of the player, upright. It follows the head smoothly,
// and only once the head looks well aside.
#pragma once

#include "engine/xr/Tracked.h"

namespace shoal::app {

class PanelPlacement {
  public:
    static constexpr float kDistance_m = 1.5f;
    static constexpr float kBelow_m = 0.1f;      // below the eyes, which is more comfortable
    static constexpr float kLag_rad = 0.6f;      // turn of the head at which the panel starts to follow
    static constexpr float kSettled_rad = 0.05f; // remaining angle at which it stops
    static constexpr float kTurn_s = 0.35f, kMove_s = 0.5f; // time constants

    // Returns the panel's pose, at first ahead of the head; once a frame. Worlds as in xr::Tracking.
    xr::Pose follow(const xr::Pose& worldFromHead, float dt_s);

  private:
    bool placed_ = false, turning_ = false;
    float yaw_ = 0; // about +Y
    glm::vec3 centre_{0};
};

} // namespace shoal::app
