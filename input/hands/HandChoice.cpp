#include "input/hands/HandChoice.h"

#include "input/hands/HandTuning.h"

#include <algorithm>

namespace shoal::hands {

namespace {

constexpr int kStretchesPerChoice = 1 << 20; // a change of device is a change of stretch, whatever they count

} // namespace

void HandChoice::frame(std::span<const DeviceHands* const> devices) {
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

void HandChoice::tick(std::array<HandPose, 2>& given, int ticksLeft, float dt_s) {
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
