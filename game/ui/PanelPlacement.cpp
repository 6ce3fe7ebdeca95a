#include "game/ui/PanelPlacement.h"

#include "engine/math/Follow.h"
#include "engine/xr/Tracked.h"

#include <cmath>
#include <numbers>

namespace shoal::app {

xr::Pose PanelPlacement::follow(const xr::Pose& worldFromHead, float dt_s) {
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

} // namespace shoal::app
