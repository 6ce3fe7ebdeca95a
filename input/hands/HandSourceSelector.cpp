#include "input/hands/HandSourceSelector.h"

#include "input/hands/HandTuning.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::hands {

namespace {

constexpr int kStretchesPerChoice = 1 << 20; // a change of device is a change of stretch, whatever they count

} // namespace

using namespace tuning;

HandPose between(const HandPose& a, const HandPose& b, float share) {
    HandPose pose = b;
    for (int i = 0; i < kJointCount; ++i) {
        glm::quat from = a.joints[i].orientation;
        const glm::quat& to = b.joints[i].orientation;
        if (glm::dot(from, to) < 0) from = -from;
        pose.joints[i].position = glm::mix(a.joints[i].position, b.joints[i].position, share);
        const glm::quat mixed = from * (1 - share) + to * share;
        const float norm = glm::length(mixed);
        pose.joints[i].orientation = norm > 1e-3f ? mixed / norm : to;
    }
    return pose;
}

const HandPose& PoseBlend::step(const HandPose& seen, int stretch, float notSeen_s, float dt_s) {
    const bool known = stretch > 0 && notSeen_s <= kBridge_s;
    if (!known) {
        pose_.tracked = false;
        pose_.confidence = 0;
        glide_s_ = 0;
        stretch_ = 0;
        return pose_;
    }
    const bool shown = pose_.tracked;
    if (!shown) {
        appear_s_ = kAppear_s;
    } else if (stretch != stretch_) {
        from_ = pose_;
        const float distance = glm::distance(seen.joints[0].position, pose_.joints[0].position);
        glideLength_s_ = glide_s_ = std::clamp(distance / kGlide_mps, kGlideMin_s, kGlideMax_s);
        from_.solid = pose_.solid && distance < kNear_m;
    }
    stretch_ = stretch;
    appear_s_ = std::max(0.0f, appear_s_ - dt_s);
    glide_s_ = std::max(0.0f, glide_s_ - dt_s);
    if (glide_s_ > 0) {
        const float t = 1 - glide_s_ / glideLength_s_;
        pose_ = between(from_, seen, t * t * (3 - 2 * t));
    } else {
        pose_ = seen;
    }
    pose_.tracked = true;
    pose_.solid = seen.solid && appear_s_ <= 0 && (glide_s_ <= 0 || from_.solid);
    pose_.confidence = seen.confidence * std::max(0.0f, 1 - notSeen_s / kBridge_s);
    return pose_;
}

void HandSourceSelector::frame(std::span<const DeviceHands* const> devices) {
    int best = kMouse;
    for (size_t i = 0; i < devices.size() && best == kMouse; ++i)
        if (devices[i]->seesHands(tuning::kMouseReturns_s)) best = static_cast<int>(i);
    if (best != chosen_) {
        changes_ = (changes_ + 1) % 1024;
        chosen_ = best;
        everChosen_ = true;
    }
    if (chosen_ == kMouse) return;
    const DeviceHands& device = *devices[static_cast<size_t>(chosen_)];
    for (int side = 0; side < 2; ++side) {
        Hand& hand = hands_[static_cast<size_t>(side)];
        hand.newest = device.hand(side).pose();
        hand.stretch = device.hand(side).stretch();
        hand.notSeen_s = device.notSeen_s(side);
    }
}

void HandSourceSelector::tick(std::array<HandPose, 2>& given, int ticksLeft, float dt_s) {
    if (!everChosen_) {
        // Known to the continuity, so that the first change of source is a glide too.
        for (size_t side = 0; side < 2; ++side) hands_[side].continuity.take(given[side]);
        return;
    }
    for (size_t side = 0; side < 2; ++side) {
        Hand& hand = hands_[side];
        const bool mouse = chosen_ == kMouse;
        const int own = mouse ? 1 : hand.stretch;
        const int stretch = own > 0 ? own % kStretchesPerChoice + 1 + changes_ * kStretchesPerChoice : 0;
        const HandPose& newest = mouse ? given[side] : hand.newest;
        const bool goesOn = stretch == hand.targetStretch && !mouse;
        hand.target =
            goesOn ? between(hand.target, newest, 1.0f / static_cast<float>(std::max(ticksLeft, 1))) : newest;
        hand.targetStretch = stretch;
        const float notSeen_s = mouse ? 0 : hand.notSeen_s;
        given[side] = hand.continuity.step(hand.target, stretch, notSeen_s, dt_s);
    }
}

} // namespace shoal::hands
