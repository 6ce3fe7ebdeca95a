// Tracking data of a headset: plain data, in the units and axes of the game (metres, radians, +Y up, -Z
// ahead), which are OpenXR's too. Includes nothing of OpenXR.
#pragma once

#include "engine/render/View.h"
#include "engine/scene/HandPose.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace shoal::xr {

struct Pose {
    glm::vec3 position{0};
    glm::quat orientation{1, 0, 0, 0};
};

inline Pose operator*(const Pose& worldFromA, const Pose& aFromB) {
    return {worldFromA.position + worldFromA.orientation * aFromB.position,
            worldFromA.orientation * aFromB.orientation};
}
inline Pose inverse(const Pose& pose) {
    const glm::quat turn = glm::conjugate(pose.orientation);
    return {turn * -pose.position, turn};
}
// Interpolates between two poses: a at share 0, b at 1.
inline Pose between(const Pose& a, const Pose& b, float share) {
    return {glm::mix(a.position, b.position, share),
            glm::normalize(glm::slerp(a.orientation, b.orientation, share))};
}

// Angles from the view's middle to its edges, radians; left and down are negative.
struct Fov {
    float left = 0, right = 0, up = 0, down = 0;
};

struct Eye {
    Pose worldFromEye;
    Fov fov;
};

struct Controller {
    std::optional<Pose> worldFromGrip; // OpenXR's grip pose: in the palm; empty: not held, or not tracked
    float squeeze = 0;                 // pressure on the button under the middle finger, 0 to 1
    float trigger = 0;                 // pressure on the button under the index finger, 0 to 1
    bool menu = false;
};

// The tracking data of one moment.
struct Tracking {
    bool headTracked = false;  // the orientation is known; otherwise head and eyes are as last known
    bool positionLost = false; // the position is not known: the last one is kept
    Pose worldFromHead;        // pose of the middle between the eyes
    // Height of the floor, world frame; empty: unknown.
    std::optional<float> floor_m;
    std::array<Eye, 2> eyes{}; // left, right
    // Bare hands, left and right: joints in the world frame; grip and pinch are not set. A hand is tracked if
    // all joints are known; its confidence is the share of joints that are measured, not guessed.
    std::array<hands::HandPose, 2> hands{};
    std::array<Controller, 2> controllers{}; // left, right
};

// Returns the renderer's view of an eye. The frustum's edges lie at the tangents of the field of view.
inline render::View viewOf(const Eye& eye) {
    const float left = std::tan(eye.fov.left), right = std::tan(eye.fov.right);
    const float down = std::tan(eye.fov.down), up = std::tan(eye.fov.up);
    return {.eyeWorld = eye.worldFromEye.position,
            .worldFromEye = eye.worldFromEye.orientation,
            .verticalFov = 2 * std::atan((up - down) / 2),
            .aspect = (right - left) / (up - down),
            .shift = {(left + right) / 2, (down + up) / 2}};
}

// Returns whether positions are finite and within 100 m and the orientation has unit length within a tenth.
inline bool believable(const Pose& pose) {
    constexpr float kFar_m = 100;
    const float norm = glm::dot(pose.orientation, pose.orientation);
    // Written so that NaN fails.
    return glm::dot(pose.position, pose.position) <= kFar_m * kFar_m && norm > 0.81f && norm < 1.21f;
}

// Returns whether all edges are within 89 degrees, right of left, up above down.
inline bool believable(const Fov& fov) {
    constexpr float kMax = 1.553f; // 89 degrees
    return fov.left >= -kMax && fov.right <= kMax && fov.down >= -kMax && fov.up <= kMax &&
           fov.right - fov.left > 0.01f && fov.up - fov.down > 0.01f;
}

// Returns the origin of a dive that starts with this pose of the head: at the eyes, upright, with -Z where
// they look. Both poses are in the same frame.
inline Pose originAt(const Pose& head) {
    const glm::vec3 ahead = head.orientation * glm::vec3(0, 0, -1);
    // If the player looks straight up or down, the top of the head gives the direction ahead.
    const glm::vec3 top = head.orientation * glm::vec3(0, ahead.y > 0 ? -1.0f : 1.0f, 0);
    const glm::vec3 flat = std::hypot(ahead.x, ahead.z) > 0.1f ? ahead : top;
    const float yaw = std::atan2(-flat.x, -flat.z); // about +Y
    return {head.position, glm::angleAxis(yaw, glm::vec3(0, 1, 0))};
}

} // namespace shoal::xr
