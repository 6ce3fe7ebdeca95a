#include "input/hands/CompleteHand.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace shoal::hands {

constexpr float kSizeMin = 0.6f, kSizeMax = 1.5f; // a child's, a giant's, relative to the rig's, a man's
constexpr float kBentWhenUnseen = 0.9f;           // curl of a finger that an old service does not show

static glm::quat frameOf(glm::vec3 direction, glm::vec3 normal) {
    return glm::normalize(glm::quatLookAt(glm::normalize(direction), glm::normalize(-normal)));
}

// Returns the smallest rotation from one direction to another.
static glm::quat rotationBetween(const glm::vec3& from, const glm::vec3& to) {
    return {glm::normalize(from), glm::normalize(to)};
}

bool agreesWithJoints(PartialHand& hand) {
    const auto &index = hand.joints[kFingerJoints[1].proximal],
               &little = hand.joints[kFingerJoints[4].proximal];
    if (!index || !little || !(glm::distance(*index, *little) > 1e-3f)) return true;
    const glm::vec3 thumbwards = glm::normalize(*index - *little);
    // Fingers bend about an axis that points to the thumb's side in a right hand, away from it in a left one.
    // bend: sum of the sines of four fingers' outer two bends; bends at the roots go either way.
    float bend = 0;
    for (int finger = 1; finger < kFingerCount; ++finger) {
        const int proximal = kFingerJoints[finger].proximal;
        std::array<glm::vec3, 3> bones{};
        for (int i = 0; i < 3; ++i) {
            const auto &from = hand.joints[proximal + i], &to = hand.joints[proximal + i + 1];
            if (!from || !to) return true;
            bones[i] = *to - *from;
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
    constexpr float kRigWidth_m = 0.085f; // between the outer edges of its knuckles
    const float byPalm = hand.palmWidth_m.value_or(kRigWidth_m) / kRigWidth_m;
    return std::clamp(rigs > 0 ? measured / rigs : byPalm, kSizeMin, kSizeMax);
}

// Assigns the loose fingertips to fingers, in the same order across the hand: to those whose angles, seen
// from the palm, are nearest to the tips' in a flat hand.
HandCompleter::Fit HandCompleter::fitTips(const PartialHand& hand, Side side) const {
    const HandPose& rest = rest_[side == Side::Left ? 0 : 1];
    const float thumbwards = side == Side::Left ? 1.0f : -1.0f; // sign of x on the thumb's side
    const auto angle = [&](glm::vec3 inPalm) { return std::atan2(thumbwards * inPalm.x, -inPalm.z); };
    const glm::quat palmFromDevice = glm::conjugate(frameOf(hand.direction, hand.normal));
    std::array<float, kFingerCount> fingers{};
    for (int f = 0; f < kFingerCount; ++f)
        fingers[f] = angle(glm::conjugate(rest.joints[kPalmJoint].orientation) *
                           (rest.joints[kFingerJoints[f].tip].position - rest.joints[kPalmJoint].position));
    std::array<std::pair<float, int>, kFingerCount> tips; // unused ones sort behind the others
    tips.fill({-std::numeric_limits<float>::infinity(), -1});
    const int count = hand.looseTipCount;
    for (int t = 0; t < count; ++t) tips[t] = {angle(palmFromDevice * (hand.looseTips[t] - hand.palm)), t};
    std::sort(tips.begin(), tips.end(), std::greater<>()); // the thumb's side first

    Fit best{.cost = std::numeric_limits<float>::max()};
    for (unsigned chosen = 0; chosen < 1u << kFingerCount; ++chosen) {
        if (std::popcount(chosen) != count) continue;
        Fit fit;
        for (int f = 0, t = 0; f < kFingerCount; ++f) {
            if (!(chosen >> f & 1u)) continue;
            const float apart = tips[t].first - fingers[f];
            fit.cost += apart * apart;
            fit.fingerOfTip[tips[t++].second] = f;
        }
        if (fit.cost < best.cost) best = fit;
    }
    return best;
}

std::optional<Side> HandCompleter::sideOfTips(const PartialHand& hand) const {
    if (hand.looseTipCount < 4) return std::nullopt; // without a thumb the hands look alike
    return fitTips(hand, Side::Left).cost < fitTips(hand, Side::Right).cost ? Side::Left : Side::Right;
}

struct HandCompleter::Placement {
    const PartialHand& hand;
    Side side;
    const HandPose& rest;
    float size;
    glm::quat deviceFromRest;

    glm::vec3 position(const HandPose& rigHand, int joint) const {
        return hand.palm +
               deviceFromRest * (rigHand.joints[joint].position - rest.joints[kPalmJoint].position) * size;
    }
};

void HandCompleter::placeFinger(int finger, const Placement& placement,
                                std::array<Joint, kJointCount>& joints) const {
    const JointPositions& at = placement.hand.joints;
    const int metacarpal = kFingerJoints[finger].metacarpal, tip = kFingerJoints[finger].tip;
    const int root = finger == 0 ? metacarpal : metacarpal + 1; // from which the finger bends
    const glm::vec3 rootAt = at[root].value_or(placement.position(placement.rest, root));
    bool whole = true;
    for (int i = root; i <= tip; ++i) {
        whole &= at[i].has_value();
        joints[i].position = at[i].value_or(rootAt);
    }
    if (!whole) {
        // Bends the rig's finger until its tip is as far from its root as the one seen, and rotates it there.
        const auto bent = [&](float curl) {
            HandShape shape;
            shape.curl[finger] = curl;
            return rig_.pose(placement.side, shape, {});
        };
        float low = 0, high = 1;
        if (at[tip]) {
            const float wanted = glm::distance(*at[tip], rootAt);
            for (int step = 0; step < 14; ++step) {
                const float middle = (low + high) / 2;
                const HandPose pose = bent(middle);
                const float reach =
                    placement.size * glm::distance(pose.joints[tip].position, pose.joints[root].position);
                (reach > wanted ? low : high) = middle;
            }
        } else {
            low = placement.hand.grip.value_or(kBentWhenUnseen);
        }
        const HandPose pose = bent(low);
        const glm::vec3 rigRoot = placement.position(pose, root);
        glm::quat turn(1, 0, 0, 0);
        if (at[tip] && glm::distance(*at[tip], rootAt) > 1e-4f)
            turn = rotationBetween(placement.position(pose, tip) - rigRoot, *at[tip] - rootAt);
        for (int i = root + 1; i <= tip; ++i)
            joints[i].position = rootAt + turn * (placement.position(pose, i) - rigRoot);
    }
    if (finger == 0) return;
    const glm::vec3 back = placement.position(placement.rest, metacarpal) - rootAt;
    const float length = placement.size * rig_.boneLength(root);
    joints[metacarpal].position =
        at[metacarpal].value_or(rootAt + back * (length / std::max(glm::length(back), 1e-4f)));
}

HandPose HandCompleter::complete(const PartialHand& given, Side side) const {
    PartialHand hand = given;
    if (hand.looseTipCount > 0) {
        const Fit fit = fitTips(hand, side);
        for (int t = 0; t < hand.looseTipCount; ++t)
            hand.joints[kFingerJoints[fit.fingerOfTip[t]].tip] = hand.looseTips[t];
    }
    const HandPose& rest = rest_[side == Side::Left ? 0 : 1];
    const glm::quat palmTurn = frameOf(hand.direction, hand.normal);
    const Placement placement{hand, side, rest, sizeOf(hand),
                              palmTurn * glm::conjugate(rest.joints[kPalmJoint].orientation)};

    HandPose out;
    out.tracked = true;
    out.confidence = std::clamp(hand.confidence.value_or(1.0f), 0.0f, 1.0f);
    auto& joints = out.joints;
    joints[kPalmJoint].position = hand.palm;
    joints[kWristJoint].position = hand.joints[kWristJoint].value_or(placement.position(rest, kWristJoint));
    for (int finger = 0; finger < kFingerCount; ++finger) placeFinger(finger, placement, joints);
    for (int i = 0; i < kJointCount; ++i) joints[i].radius = rest.joints[i].radius * placement.size;

    // Turns each joint as the rig would after its parent, then by the smallest rotation onto its bone, so
    // that nothing flips when a finger is bent by a right angle.
    joints[kPalmJoint].orientation = palmTurn;
    joints[kWristJoint].orientation = placement.deviceFromRest * rest.joints[kWristJoint].orientation;
    for (int i = 2; i < kJointCount; ++i) {
        const int parent = kJointParent[i];
        const glm::quat expected = joints[parent].orientation *
                                   glm::conjugate(rest.joints[parent].orientation) *
                                   rest.joints[i].orientation;
        const glm::vec3 bone = isTip(i) ? glm::vec3(0) : joints[i + 1].position - joints[i].position;
        const bool usable = glm::length(bone) > 1e-4f;
        joints[i].orientation =
            usable ? glm::normalize(rotationBetween(expected * glm::vec3(0, 0, -1), bone) * expected)
                   : expected;
    }
    out.grip = std::clamp(hand.grip.value_or(gripOf(joints)), 0.0f, 1.0f);
    out.pinch = std::clamp(hand.pinch.value_or(pinchOf(joints)), 0.0f, 1.0f);
    return out;
}

} // namespace shoal::hands
