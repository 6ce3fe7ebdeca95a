// Tracking data of a headset: plain data, in the units and axes of the game (metres, radians, +Y up, -Z
// ahead), which are OpenXR's too. Includes nothing of OpenXR.
#pragma once

#include "engine/render/View.h"
#include "engine/scene/HandPose.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace shoal::xr {

struct Pose {
    glm::vec3 position{0};
    glm::quat orientation{1, 0, 0, 0};
};

// Chains `worldFromA` and `aFromB` to `worldFromB`.
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

// A controller held in a hand.
struct Controller {
    bool active = false;
    bool gripValid = false;
    Pose worldFromGrip; // OpenXR's grip pose: in the palm
    float squeeze = 0;  // pressure on the button under the middle finger, 0 to 1
    float trigger = 0;  // pressure on the button under the index finger, 0 to 1
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

// Conversion of a headset's eyes to views of the renderer, and plausibility checks of what a runtime reports.

// Returns the renderer's view of an eye. The frustum's edges lie at the tangents of the field of view.
render::View viewOf(const Eye& eye);

// Returns whether positions are finite and within 100 m and the orientation has unit length within a tenth.
bool believable(const Pose& pose);
// Returns whether all edges are within 89 degrees, right of left, up above down.
bool believable(const Fov& fov);

// Returns the origin of a dive that starts with this pose of the head: at the eyes, upright, with -Z where
// they look. Both poses are in the same frame.
Pose originAt(const Pose& head);

} // namespace shoal::xr
