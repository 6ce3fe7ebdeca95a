#include "input/hands/CompleteHand.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

constexpr float kSizeMin = 0.6f, kSizeMax = 1.5f; // a child's, a giant's, relative to the rig's, a man's

bool agreesWithJoints(PartialHand& hand) {
    const auto &index = hand.joints[kFingerJoints[1].proximal],
               &little = hand.joints[kFingerJoints[4].proximal];
    if (!(glm::distance(*index, *little) > 1e-3f)) return true;
    const glm::vec3 thumbwards = glm::normalize(*index - *little);
    // Fingers bend about an axis that points to the thumb's side in a right hand, away from it in a left one.
    // bend: sum of the sines of four fingers' outer two bends; bends at the roots go either way.
    float bend = 0;
    for (int finger = 1; finger < kFingerCount; ++finger) {
        const int proximal = kFingerJoints[finger].proximal;
        std::array<glm::vec3, 3> bones{};
        for (int i = 0; i < 3; ++i) {
            bones[i] = *hand.joints[proximal + i + 1] - *hand.joints[proximal + i];
            bones[i] /= std::max(glm::length(bones[i]), 1e-4f);
        }
        bend += glm::dot(glm::cross(bones[0], bones[1]) + glm::cross(bones[1], bones[2]), thumbwards);
    }
    constexpr float kTells = 0.1f;  // least bend that tells the side; recorded flat hands have 0.12 and more
    constexpr float kOverrules = 2; // least bend that overrules side and normal: 15 degrees a joint
    const Side byBend = bend > 0 ? Side::Right : Side::Left;
    const Side byNormal =
        glm::dot(glm::cross(hand.direction, hand.normal), thumbwards) > 0 ? Side::Right : Side::Left;
    const bool disagree = byNormal != *hand.side;
    if (disagree && std::fabs(bend) < kTells) return false;
    if (!disagree && std::fabs(bend) < kOverrules) return true;
    hand.side = byBend;
    if (byNormal != byBend) hand.normal = -hand.normal;
    return true;
}

float HandCompleter::sizeOf(const PartialHand& hand) const {
    const JointPositions& at = hand.joints;
    float measured = 0, rigs = 0;
    for (int i = 3; i < kJointCount; ++i) { // whole bones, without the carpus and the tips' flesh
        const int parent = kJointParent[i];
        if (parent < 2 || isTip(i) || !at[i] || !at[parent]) continue;
        measured += glm::distance(*at[i], *at[parent]);
        rigs += rig_.boneLength(i);
    }
    return std::clamp(measured / rigs, kSizeMin, kSizeMax);
}

HandPose HandCompleter::complete(const PartialHand& hand, Side side) const {
    const HandPose& rest = rest_[side == Side::Left ? 0 : 1];
    const glm::quat palmTurn =
        glm::normalize(glm::quatLookAt(glm::normalize(hand.direction), glm::normalize(-hand.normal)));
    const glm::quat deviceFromRest = palmTurn * glm::conjugate(rest.joints[kPalmJoint].orientation);
    const float size = sizeOf(hand);

    HandPose out{.tracked = true, .confidence = std::clamp(hand.confidence.value_or(1.0f), 0.0f, 1.0f)};
    auto& joints = out.joints;
    for (int i = 0; i < kJointCount; ++i) {
        const glm::vec3 inRest = rest.joints[i].position - rest.joints[kPalmJoint].position;
        joints[i].position = hand.joints[i].value_or(hand.palm + deviceFromRest * inRest * size);
        joints[i].radius = rest.joints[i].radius * size;
    }
    for (const auto& [metacarpal, proximal, tip] : kFingerJoints) {
        if (hand.joints[metacarpal]) continue;
        const glm::vec3 root = joints[proximal].position, back = joints[metacarpal].position - root;
        const float length = size * rig_.boneLength(proximal);
        joints[metacarpal].position = root + back * (length / std::max(glm::length(back), 1e-4f));
    }

    // Turns each joint as the rig would after its parent, then by the smallest rotation onto its bone, so
    // that nothing flips when a finger is bent by a right angle.
    joints[kPalmJoint].orientation = palmTurn;
    joints[kWristJoint].orientation = deviceFromRest * rest.joints[kWristJoint].orientation;
    for (int i = 2; i < kJointCount; ++i) {
        const int parent = kJointParent[i];
        const glm::quat expected = joints[parent].orientation *
                                   glm::conjugate(rest.joints[parent].orientation) *
                                   rest.joints[i].orientation;
        const glm::vec3 bone = isTip(i) ? glm::vec3(0) : joints[i + 1].position - joints[i].position;
        joints[i].orientation = expected;
        if (!(glm::length(bone) > 1e-4f)) continue;
        const glm::quat least(glm::normalize(expected * glm::vec3(0, 0, -1)), glm::normalize(bone));
        joints[i].orientation = glm::normalize(least * expected);
    }
    out.grip = std::clamp(hand.grip.value_or(gripOf(joints)), 0.0f, 1.0f);
    out.pinch = std::clamp(hand.pinch.value_or(pinchOf(joints)), 0.0f, 1.0f);
    return out;
}

} // namespace shoal::hands
