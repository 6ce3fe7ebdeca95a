// Placement of the text panel in a headset: in front of the player, upright. It follows the head smoothly,
// and only once the head looks well aside.
#pragma once

#include "engine/math/Trigonometry.h"
#include "engine/xr/Tracked.h"

#include <cmath>
#include <numbers>

namespace shoal::app {

class PanelPlacement {
  public:
    static constexpr float kDistance_m = 1.5f;
    static constexpr float kBelow_m = 0.1f;      // below the eyes, which is more comfortable
    static constexpr float kLag_rad = 0.6f;      // turn of the head at which the panel starts to follow
    static constexpr float kSettled_rad = 0.05f; // remaining angle at which it stops
    static constexpr float kTurn_s = 0.35f, kMove_s = 0.5f; // time constants

    // Returns the panel's pose, at first ahead of the head; once a frame. Worlds as in xr::Tracking.
    xr::Pose follow(const xr::Pose& worldFromHead, float dt_s) {
        const xr::Pose upright = xr::originAt(worldFromHead);
        const float headYaw = 2 * std::atan2(upright.orientation.y, upright.orientation.w);
        if (!placed_) {
            placed_ = true;
            yaw_ = headYaw;
            centre_ = upright.position;
        }
        const float aside = std::remainder(headYaw - yaw_, 2 * std::numbers::pi_v<float>);
        if (std::abs(aside) > kLag_rad) turning_ = true;
        if (std::abs(aside) < kSettled_rad) turning_ = false;
        if (turning_) yaw_ += aside * math::followShare(dt_s, kTurn_s);
        centre_ += (upright.position - centre_) * math::followShare(dt_s, kMove_s);
        const glm::quat turn = glm::angleAxis(yaw_, glm::vec3(0, 1, 0));
        return {centre_ + turn * glm::vec3(0, -kBelow_m, -kDistance_m), turn};
    }

  private:
    bool placed_ = false, turning_ = false;
    float yaw_ = 0; // about +Y
    glm::vec3 centre_{0};
};

} // namespace shoal::app
