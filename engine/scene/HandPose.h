// Pose of one hand: the 26 joints of OpenXR's XR_EXT_hand_tracking, their names, hierarchy and fingers. The
// one place for joint indices. Plain data; metres.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace shoal::hands {

enum class Side { Left, Right };

constexpr int kJointCount = 26;

// Names in OpenXR's order; the joints of content/models/hand_*.glb are named the same.
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

// Parent of each joint; -1 for the wrist, the root. The palm's parent is the wrist.
constexpr std::array<int, kJointCount> kJointParent = {1,  -1, 1,  2, 3,  4,  1,  6,  7, 8,  9,  1,  11,
                                                       12, 13, 14, 1, 16, 17, 18, 19, 1, 21, 22, 23, 24};

enum class Finger { Thumb, Index, Middle, Ring, Little };
constexpr int kFingerCount = 5;

constexpr int kPalmJoint = 0, kWristJoint = 1;
struct FingerJoints {
    int metacarpal = 0, proximal = 0, tip = 0; // the joints between them follow in order
    constexpr int count() const { return tip - metacarpal + 1; }
};
constexpr std::array<FingerJoints, kFingerCount> kFingerJoints = {
    {{2, 3, 5}, {6, 7, 10}, {11, 12, 15}, {16, 17, 20}, {21, 22, 25}}}; // by Finger
constexpr int kMaxFingerJoints = 5;                                     // the thumb has four

// Finger of a joint, -1 for palm and wrist.
constexpr int fingerOfJoint(int joint) {
    for (int finger = 0; finger < kFingerCount; ++finger)
        if (joint >= kFingerJoints[finger].metacarpal && joint <= kFingerJoints[finger].tip) return finger;
    return -1;
}

// Parts of a hand that touch and feel: the five fingers, indexed by Finger, and the palm.
constexpr int kHandParts = kFingerCount + 1;
constexpr int kPalmPart = kFingerCount;

// OpenXR's convention: -Z points towards the fingertip, +Y out of the back of the hand, +X to its right.
struct Joint {
    glm::vec3 position{0}; // metres
    glm::quat orientation{1, 0, 0, 0};
    float radius = 0.008f; // metres
};

struct HandPose {
    bool tracked = false;
    float confidence = 0; // 0 to 1
    float grip = 0;       // 0 open to 1 fist
    float pinch = 0;      // 0 open to 1 thumb and index touch; a fist is not also a pinch
    // Whether the hand collides with things. False while it glides to where it is seen again, and just after
    // it has appeared: it then keeps what it holds, and passes through everything else.
    bool solid = true;
    int64_t time_us = 0; // time of the measurement, by the source's own clock
    // Viewer's frame: eye at the origin, -Z ahead, +Y up, metres.
    std::array<Joint, kJointCount> joints{};
};

// A hand closes when its grip rises through kGripCloses and opens when it falls through kGripOpens.
constexpr float kGripCloses = 0.55f;
constexpr float kGripOpens = 0.35f;
// A hand that is not seen for longer is lost: it lets go of its fish. Devices give 5 to 200 frames a second.
constexpr float kHandLost_s = 0.3f;

// Returns the middle of the space that a closing hand encloses, in the joints' frame.
inline glm::vec3 graspCentre(const std::array<Joint, kJointCount>& joints) {
    const Joint& palm = joints[kPalmJoint];
    return palm.position + palm.orientation * glm::vec3(0, -0.045f, -0.035f);
}

// True when all joints are finite, within 5 m of the eye, orientations near unit length, radii 1 mm to 10 cm,
// bones below 25 cm.
inline bool plausible(const HandPose& hand) {
    const auto finite = [](float v) { return std::isfinite(v); };
    if (!finite(hand.grip) || !finite(hand.pinch) || !finite(hand.confidence)) return false;
    for (int i = 0; i < kJointCount; ++i) {
        const Joint& joint = hand.joints[i];
        const glm::vec3 p = joint.position;
        if (!finite(p.x) || !finite(p.y) || !finite(p.z) || !(glm::dot(p, p) < 25)) return false;
        const float norm = glm::dot(joint.orientation, joint.orientation);
        if (!(norm > 0.9f && norm < 1.1f)) return false;
        if (!(joint.radius >= 0.001f && joint.radius <= 0.1f)) return false;
        const int parent = kJointParent[i];
        if (parent >= 0 && !(glm::distance(p, hand.joints[parent].position) < 0.25f)) return false;
    }
    return true;
}

} // namespace shoal::hands
