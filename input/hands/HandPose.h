// One hand as every source gives it: the 26 joints of OpenXR's XR_EXT_hand_tracking.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <string_view>

namespace shoal::hands {

enum class Side { Left, Right };

constexpr int kJointCount = 26;

// In OpenXR's order; content/models/hand_*.glb names its joints the same.
constexpr std::array<std::string_view, kJointCount> kJointNames = {
    "palm",
    "wrist",
    "thumb_metacarpal",
    "thumb_proximal",
    "thumb_distal",
    "thumb_tip",
    "index_metacarpal",
    "index_proximal",
    "index_intermediate",
    "index_distal",
    "index_tip",
    "middle_metacarpal",
    "middle_proximal",
    "middle_intermediate",
    "middle_distal",
    "middle_tip",
    "ring_metacarpal",
    "ring_proximal",
    "ring_intermediate",
    "ring_distal",
    "ring_tip",
    "little_metacarpal",
    "little_proximal",
    "little_intermediate",
    "little_distal",
    "little_tip",
};

// The joint each joint hangs from; -1 for the wrist, the root. The palm hangs from the wrist.
constexpr std::array<int, kJointCount> kJointParent = {1,  -1, 1,  2, 3,  4,  1,  6,  7, 8,  9,  1,  11,
                                                       12, 13, 14, 1, 16, 17, 18, 19, 1, 21, 22, 23, 24};

enum class Finger { Thumb, Index, Middle, Ring, Little };
constexpr int kFingerCount = 5;

// OpenXR's convention: -Z points towards the fingertip, +Y out of the back of the hand, +X to its right.
struct Joint {
    glm::vec3 position{0}; // metres
    glm::quat orientation{1, 0, 0, 0};
    float radius = 0.008f; // metres
};

struct HandPose {
    bool tracked = false;
    bool solid = true;    // may touch and push; false while it glides to where tracking came back
    float confidence = 0; // 0 to 1
    float grip = 0;       // 0 open to 1 fist
    float pinch = 0;      // 0 open to 1 thumb and index touch
    std::array<Joint, kJointCount>
        joints{}; // in the viewer's frame: eye at the origin, -Z ahead, +Y up, metres
};

} // namespace shoal::hands
