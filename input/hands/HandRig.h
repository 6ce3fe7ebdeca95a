// A hand of fixed bone lengths, posed by how far each finger is bent: for sources that do not see all joints.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/scene/HandPose.h"

#include <array>

namespace shoal::hands {

constexpr bool isTip(int joint) {
    const int finger = fingerOfJoint(joint);
    return finger >= 0 && kFingerJoints[finger].tip == joint;
}

struct HandShape {
    std::array<float, kFingerCount> curl{}; // per hands::Finger: 0 straight to 1 bent into a fist
    float spread = 0;                       // -1 fingers together, 0 as at rest, 1 fanned
};

// Pose of a wrist or a palm, viewer's frame.
struct JointPose {
    glm::vec3 position{0};
    glm::quat orientation{1, 0, 0, 0}; // -Z towards the fingers, +Y out of the back of the hand
};

class HandRig {
  public:
    // Reads content/models/hand_skeleton.json.
    static Result<HandRig> load(const Path& file);

    // Returns a tracked hand; grip and pinch follow from its joints. The left hand mirrors the right.
    HandPose pose(Side, const HandShape&, const JointPose& wrist) const;

    // Returns the length of the bone from kJointParent[joint] to the joint, metres; 0 for the wrist.
    float boneLength(int joint) const { return glm::length(parentFromJointOffset_[joint]); }

  private:
    std::array<glm::vec3, kJointCount> parentFromJointOffset_{};
    std::array<glm::quat, kJointCount> parentFromJointTurn_{};
    std::array<float, kJointCount> radius_{};
};

// Estimate grip (from the bends of four fingers) and pinch (from the gap between thumb tip and index tip) for
// sources that give none. 0 to 1.
float gripOf(const std::array<Joint, kJointCount>&);
float pinchOf(const std::array<Joint, kJointCount>&);

// Range of distances of a hand's grasp centre from the eye, metres.
constexpr float kReachMin_m = 0.25f;
constexpr float kReachMax_m = 1.6f;

} // namespace shoal::hands
