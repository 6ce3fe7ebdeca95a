#include "engine/xr/Tracked.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::xr {

render::View viewOf(const Eye& eye) {
    const float left = std::tan(eye.fov.left), right = std::tan(eye.fov.right);
    const float down = std::tan(eye.fov.down), up = std::tan(eye.fov.up);
    render::View view;
    view.eyeWorld = eye.worldFromEye.position;
    view.worldFromEye = eye.worldFromEye.orientation;
    view.verticalFov = 2 * std::atan((up - down) / 2);
    view.aspect = (right - left) / (up - down);
    view.shift = {(left + right) / 2, (down + up) / 2};
    return view;
}

bool believable(const Pose& pose) {
    constexpr float kFar_m = 100;
    const float norm = glm::dot(pose.orientation, pose.orientation);
    // Written so that NaN fails.
    return glm::dot(pose.position, pose.position) <= kFar_m * kFar_m && norm > 0.81f && norm < 1.21f;
}

bool believable(const Fov& fov) {
    constexpr float kMax = 1.553f; // 89 degrees
    return fov.left >= -kMax && fov.right <= kMax && fov.down >= -kMax && fov.up <= kMax &&
           fov.right - fov.left > 0.01f && fov.up - fov.down > 0.01f;
}

Pose originAt(const Pose& head) {
    const glm::vec3 ahead = head.orientation * glm::vec3(0, 0, -1);
    // If the player looks straight up or down, the top of the head gives the direction ahead.
    const glm::vec3 top = head.orientation * glm::vec3(0, ahead.y > 0 ? -1.0f : 1.0f, 0);
    const glm::vec3 flat = std::hypot(ahead.x, ahead.z) > 0.1f ? ahead : top;
    const float yaw = std::atan2(-flat.x, -flat.z); // about +Y
    return {head.position, glm::angleAxis(yaw, glm::vec3(0, 1, 0))};
}

} // namespace shoal::xr
