// The bones of a hand: which joint ends which, and what they belong to.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/scene/HandPose.h"

#include <algorithm>

namespace shoal::game {

// Finger, or the palm, that the bone from kJointParent[joint] to the joint belongs to. The bones of the back
// of the hand are the palm's.
inline int partOfBone(int joint) {
    const int finger = hands::fingerOfJoint(joint);
    if (finger < 0) return hands::kPalmPart;
    const hands::FingerJoints& joints = hands::kFingerJoints[finger];
    const bool thumb = finger == 0; // whose proximal bone moves on its own
    return joint <= (thumb ? joints.metacarpal : joints.proximal) ? hands::kPalmPart : finger;
}

inline physics::Capsule bone(const std::array<hands::Joint, hands::kJointCount>& joints, int joint) {
    const hands::Joint& from = joints[hands::kJointParent[joint]];
    const hands::Joint& to = joints[joint];
    return {from.position, to.position, std::min(from.radius, to.radius)};
}

// Where a fish of that radius lies in a hand, given the palm joint.
inline glm::vec3 hollowOf(const hands::Joint& palm, float radius_m) {
    return palm.position + palm.orientation * glm::vec3(0, -0.008f - radius_m, -0.030f);
}

} // namespace shoal::game
