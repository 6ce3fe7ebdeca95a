// Place of the text panel in a headset: before the player, upright. It follows the head only once that looks
// well aside, and then smoothly.
#pragma once

#include "engine/xr/Tracked.h"

namespace shoal::app {

class PanelPlacement {
  public:
    static constexpr float kDistance_m = 1.5f;
    static constexpr float kBelow_m = 0.1f;                 // the eyes, which is more comfortable
    static constexpr float kLag_rad = 0.6f;                 // the head may turn so far before it follows
    static constexpr float kSettled_rad = 0.05f;            // and then it follows until so near
    static constexpr float kTurn_s = 0.35f, kMove_s = 0.5f; // time constants

    // Once a frame. Worlds as in xr::Tracking. The first call places it ahead of the head.
    xr::Pose follow(const xr::Pose& worldFromHead, float dt_s);

  private:
    bool placed_ = false, turning_ = false;
    float yaw_ = 0; // about +Y
    glm::vec3 centre_{0};
};

} // namespace shoal::app
