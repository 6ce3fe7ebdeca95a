// Tracking data of a headset: plain data, in the units and axes of the game (metres, radians, +Y up, -Z
// ahead), which are OpenXR's too. Needs nothing of OpenXR.
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

// `worldFromA`, `aFromB` give `worldFromB`.
inline Pose operator*(const Pose& worldFromA, const Pose& aFromB) {
    return {worldFromA.position + worldFromA.orientation * aFromB.position,
            worldFromA.orientation * aFromB.orientation};
}
inline Pose inverse(const Pose& pose) {
    const glm::quat turn = glm::conjugate(pose.orientation);
    return {turn * -pose.position, turn};
}
// Between two poses: a at share 0, b at 1.
inline Pose between(const Pose& a, const Pose& b, float share) {
    return {glm::mix(a.position, b.position, share),
            glm::normalize(glm::slerp(a.orientation, b.orientation, share))};
}

// From the middle of the view to each edge, radians; left and down are negative.
struct Fov {
    float left = 0, right = 0, up = 0, down = 0;
};

struct Eye {
    Pose worldFromEye;
    Fov fov;
};

// What is held in a hand.
struct Controller {
    bool active = false;
    bool gripValid = false;
    Pose worldFromGrip; // OpenXR's grip pose: in the palm
    float squeeze = 0;  // 0 to 1: under the middle finger
    float trigger = 0;  // 0 to 1: under the index finger
    bool menu = false;
};

// Everything of one moment.
struct Tracking {
    bool headTracked = false;  // which way it looks is known; else what follows is the last that was known
    bool positionLost = false; // the head turns where it was last known to be
    Pose worldFromHead;        // between the eyes
    // Height of the floor, world; empty: the runtime does not know it.
    std::optional<float> floor_m;
    std::array<Eye, 2> eyes{}; // left, right
    // Left, right; bare hands, joints in the world's frame, without grip and pinch. Tracked if all joints are
    // known; confidence: the share of them that is not merely guessed.
    std::array<hands::HandPose, 2> hands{};
    std::array<Controller, 2> controllers{}; // left, right
};

// Conversion of a headset's eyes to views of the renderer, and plausibility checks of what a runtime reports.

// The eye as the renderer draws it. The frustum's edges lie at the tangents of the field of view.
render::View viewOf(const Eye& eye);

// Positions finite and within 100 m, orientation of unit length to a tenth: else not to be believed.
bool believable(const Pose& pose);
// All edges within 89 degrees, right of left, up above down.
bool believable(const Fov& fov);

// Where a dive that starts with this head has its origin: at the eyes, upright, ahead where they look. Same
// frame as the head.
Pose originAt(const Pose& head);

} // namespace shoal::xr
