#include "input/hands/CompleteHand.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace shoal::hands {

namespace {

constexpr int kPalm = 0, kWrist = 1;
constexpr std::array<int, kFingerCount> kFoot = {2, 6, 11, 16, 21}; // metacarpal joint of each finger
constexpr std::array<int, kFingerCount> kTip = {5, 10, 15, 20, 25};
constexpr float kSizeLeast = 0.6f, kSizeMost = 1.5f; // of the rig's hand, a man's: a child's, a giant's
constexpr float kBentWhenUnseen = 0.9f;              // curl of a finger that an old service no longer shows

glm::quat frameOf(glm::vec3 direction, glm::vec3 normal) {
    const auto unit = [](glm::vec3 v, glm::vec3 otherwise) {
        const float length = glm::length(v);
        return length > 1e-4f ? v / length : otherwise;
    };
    const glm::vec3 z = -unit(direction, {0, 0, -1});
    glm::vec3 x = glm::cross(-normal, z);
    if (glm::length(x) < 1e-4f)
        x = glm::cross(std::fabs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), z);
    x = glm::normalize(x);
    return glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(z, x), z)));
}

// The least turn from one direction to another.
glm::quat turnOnto(glm::vec3 from, glm::vec3 to) {
    from = glm::normalize(from);
    to = glm::normalize(to);
    const float cosine = glm::dot(from, to);
    if (cosine < -0.9999f) {
        const glm::vec3 aside = std::fabs(from.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        return glm::angleAxis(3.14159265f, glm::normalize(glm::cross(from, aside)));
    }
    const glm::vec3 axis = glm::cross(from, to);
    return glm::normalize(glm::quat(1 + cosine, axis.x, axis.y, axis.z));
}

using Positions = std::array<std::optional<glm::vec3>, kJointCount>;

Positions sent(const PartialHand& hand) {
    Positions at;
    at[kPalm] = hand.palm;
    at[kWrist] = hand.wrist;
    for (int f = 0; f < kFingerCount; ++f) {
        const PartialFinger& finger = hand.fingers[f];
        int joint = kFoot[f];
        at[joint++] = finger.metacarpal;
        at[joint++] = finger.proximal;
        if (f != 0) at[joint++] = finger.intermediate;
        at[joint++] = finger.distal;
        at[joint] = finger.tip;
    }
    return at;
}

} // namespace

HandCompleter::HandCompleter(const HandRig& rig)
    : rig_(rig), rest_{rig.pose(Side::Left, {}, {}), rig.pose(Side::Right, {}, {})} {}

float HandCompleter::sizeOf(const PartialHand& hand) const {
    const Positions at = sent(hand);
    float measured = 0, rigs = 0;
    for (int i = 3; i < kJointCount;
         ++i) { // of whole bones, without the carpus and without flesh at the tips
        const int parent = kJointParent[i];
        const bool tip = std::find(kTip.begin(), kTip.end(), i) != kTip.end();
        if (parent < 2 || tip || !at[i] || !at[parent]) continue;
        measured += glm::distance(*at[i], *at[parent]);
        rigs += rig_.boneLength(i);
    }
    float size = 1;
    if (rigs > 0)
        size = measured / rigs;
    else if (hand.palmWidth_m)
        size = *hand.palmWidth_m / 0.085f; // the rig's, between the outer edges of its knuckles
    return std::clamp(size, kSizeLeast, kSizeMost);
}

// Fingers keep their order across the hand; of the ways to leave some out, the one whose angles, seen from
// the palm, are nearest to those of a flat hand.
HandCompleter::Fit HandCompleter::fitTips(const PartialHand& hand, Side side) const {
    const HandPose& rest = rest_[side == Side::Left ? 0 : 1];
    const float thumbwards = side == Side::Left ? 1.0f : -1.0f; // sign of x on the thumb's side
    const auto angle = [&](glm::vec3 inPalm) { return std::atan2(thumbwards * inPalm.x, -inPalm.z); };
    const glm::quat palmFromDevice = glm::conjugate(frameOf(hand.direction, hand.normal));
    std::array<float, kFingerCount> fingers{};
    for (int f = 0; f < kFingerCount; ++f)
        fingers[f] = angle(glm::conjugate(rest.joints[kPalm].orientation) *
                           (rest.joints[kTip[f]].position - rest.joints[kPalm].position));
    std::array<std::pair<float, int>, kFingerCount> tips;
    tips.fill({-std::numeric_limits<float>::infinity(), -1});
    const int count = hand.looseTipCount;
    for (int t = 0; t < count; ++t) tips[t] = {angle(palmFromDevice * (hand.looseTips[t] - hand.palm)), t};
    std::sort(tips.begin(), tips.end(), std::greater<>()); // the thumb's side first

    Fit best;
    best.cost = std::numeric_limits<float>::max();
    for (unsigned chosen = 0; chosen < 1u << kFingerCount; ++chosen) {
        Fit fit;
        int t = 0;
        for (int f = 0; f < kFingerCount; ++f) {
            if (!(chosen >> f & 1u)) continue;
            if (t < count) {
                const float apart = tips[t].first - fingers[f];
                fit.cost += apart * apart;
                fit.fingerOfTip[tips[t].second] = f;
            }
            ++t;
        }
        if (t == count && fit.cost < best.cost) best = fit;
    }
    return best;
}

std::optional<Side> HandCompleter::sideOfTips(const PartialHand& hand) const {
    if (hand.looseTipCount < 4) return std::nullopt; // without a thumb the hands look alike
    return fitTips(hand, Side::Left).cost < fitTips(hand, Side::Right).cost ? Side::Left : Side::Right;
}

HandPose HandCompleter::complete(const PartialHand& given, Side side) const {
    PartialHand hand = given;
    if (hand.looseTipCount > 0) {
        const Fit fit = fitTips(hand, side);
        for (int t = 0; t < hand.looseTipCount; ++t) hand.fingers[fit.fingerOfTip[t]].tip = hand.looseTips[t];
    }
    const HandPose& rest = rest_[side == Side::Left ? 0 : 1];
    const float size = sizeOf(hand);
    const glm::quat palmTurn = frameOf(hand.direction, hand.normal);
    const glm::quat deviceFromRest = palmTurn * glm::conjugate(rest.joints[kPalm].orientation);
    const auto placed = [&](const HandPose& like, int joint) {
        return hand.palm +
               deviceFromRest * (like.joints[joint].position - rest.joints[kPalm].position) * size;
    };

    const Positions at = sent(hand);
    std::array<glm::vec3, kJointCount> p;
    p[kPalm] = hand.palm;
    p[kWrist] = at[kWrist].value_or(placed(rest, kWrist));
    for (int f = 0; f < kFingerCount; ++f) {
        const int foot = kFoot[f], tip = kTip[f];
        const int root = f == 0 ? foot : foot + 1; // from which the finger bends
        bool whole = true;
        for (int i = root; i <= tip; ++i) whole &= at[i].has_value();
        p[root] = at[root].value_or(placed(rest, root));
        if (whole) {
            for (int i = root; i <= tip; ++i) p[i] = *at[i];
        } else {
            // The finger of the rig, as bent as makes its tip as far from its root as it is, turned there.
            const auto bent = [&](float curl) {
                HandShape shape;
                shape.curl[f] = curl;
                return rig_.pose(side, shape, {});
            };
            const auto reach = [&](const HandPose& pose) {
                return size * glm::distance(pose.joints[tip].position, pose.joints[root].position);
            };
            float low = 0, high = 1;
            if (at[tip]) {
                const float wanted = glm::distance(*at[tip], p[root]);
                for (int step = 0; step < 14; ++step) {
                    const float middle = (low + high) / 2;
                    (reach(bent(middle)) > wanted ? low : high) = middle;
                }
            } else {
                low = hand.grip.value_or(kBentWhenUnseen);
            }
            const HandPose pose = bent(low);
            const glm::vec3 rootWas = placed(pose, root);
            glm::quat turn(1, 0, 0, 0);
            if (at[tip] && glm::distance(*at[tip], p[root]) > 1e-4f)
                turn = turnOnto(placed(pose, tip) - rootWas, *at[tip] - p[root]);
            for (int i = root + 1; i <= tip; ++i) p[i] = p[root] + turn * (placed(pose, i) - rootWas);
        }
        if (f == 0) continue;
        if (at[foot]) {
            p[foot] = *at[foot];
        } else {
            const glm::vec3 back = placed(rest, foot) - p[root];
            p[foot] = p[root] + back * (size * rig_.boneLength(root) / std::max(glm::length(back), 1e-4f));
        }
    }

    HandPose out;
    out.tracked = true;
    out.confidence = std::clamp(hand.confidence.value_or(1.0f), 0.0f, 1.0f);
    for (int i = 0; i < kJointCount; ++i) {
        out.joints[i].position = p[i];
        out.joints[i].radius = rest.joints[i].radius * size;
    }
    // Each joint as the rig would turn it after its parent, then by the least turn onto its bone: the twist
    // is anatomy's, and nothing flips when a finger is bent by a right angle.
    out.joints[kPalm].orientation = palmTurn;
    out.joints[kWrist].orientation = deviceFromRest * rest.joints[kWrist].orientation;
    for (int i = 2; i < kJointCount; ++i) {
        const int parent = kJointParent[i];
        const glm::quat expected = out.joints[parent].orientation *
                                   glm::conjugate(rest.joints[parent].orientation) *
                                   rest.joints[i].orientation;
        const bool tip = std::find(kTip.begin(), kTip.end(), i) != kTip.end();
        const glm::vec3 bone = tip ? glm::vec3(0) : p[i + 1] - p[i];
        const bool usable = glm::length(bone) > 1e-4f;
        out.joints[i].orientation =
            usable ? glm::normalize(turnOnto(expected * glm::vec3(0, 0, -1), bone) * expected) : expected;
    }
    out.grip = std::clamp(hand.grip.value_or(gripOf(out.joints)), 0.0f, 1.0f);
    out.pinch = std::clamp(hand.pinch.value_or(pinchOf(out.joints)), 0.0f, 1.0f);
    return out;
}

} // namespace shoal::hands
