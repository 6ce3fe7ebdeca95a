// The bones of a hand: which joint ends which, and what they belong to.
#pragma once

#include "engine/physics/Capsule.h"
#include "input/hands/HandPose.h"
#include "input/haptics/HapticFrame.h"

#include <algorithm>

namespace shoal::game {

// Finger, or the palm, that the bone from kJointParent[joint] to the joint belongs to. The bones of the back
// of the hand are the palm's.
inline int partOfBone(int joint) {
    if (joint < 2) return haptics::kPalm;
    if (joint < 6) return joint == 2 ? haptics::kPalm : 0;
    const int inFinger = (joint - 6) % 5;
    return inFinger <= 1 ? haptics::kPalm : 1 + (joint - 6) / 5;
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
