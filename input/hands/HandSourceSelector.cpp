#include "input/hands/HandSourceSelector.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::hands {

constexpr std::chrono::milliseconds kPatience{2000};
constexpr int kMouse = -1; // stretch of the mouse's hands: differs from those of every tracker

using namespace tuning;

bool DeviceHands::due(HandStream& stream, HandFrame& frame) {
    if (time_ == DeviceTime::Live) return stream.take(frame);
    if (!ahead_) {
        HandFrame next;
        silent_ = !stream.take(next, silent_ ? std::chrono::milliseconds(0) : kPatience);
        if (silent_) return false;
        // When a device's clock starts or restarts, its time is matched to the game's present time.
        if (next.time_us < last_us_) gameFromDevice_us_ = game_us_ - next.time_us;
        last_us_ = next.time_us;
        ahead_ = next;
    }
    if (ahead_->time_us + gameFromDevice_us_ > game_us_) return false;
    frame = *ahead_;
    ahead_.reset();
    return true;
}

void DeviceHands::advance(HandStream& stream, double elapsed_s, Clock::time_point now) {
    game_us_ += static_cast<int64_t>(elapsed_s * 1e6);
    for (float& s : notSeen_s_) s += static_cast<float>(elapsed_s);
    HandFrame frame;
    while (due(stream, frame)) {
        const std::chrono::duration<float> late =
            time_ == DeviceTime::Live ? now - frame.seenAt
                                      : std::chrono::duration<float>(std::chrono::microseconds(
                                            game_us_ - gameFromDevice_us_ - frame.time_us));
        for (size_t side = 0; side < 2; ++side) {
            filters_[side].step(frame.hands[side], frame.identity[side], frame.time_us);
            if (!filters_[side].seen()) continue;
            notSeen_s_[side] = 0;
            lateness_s_[side] = std::max(late.count(), 0.0f);
            towardsElbow_[side] = frame.towardsElbow[side];
            rigDistance_m_[side] = frame.rigDistance_m[side];
        }
    }
}

HandPose between(const HandPose& a, const HandPose& b, float share) {
    HandPose pose = b;
    for (int i = 0; i < kJointCount; ++i) {
        pose.joints[i].position = glm::mix(a.joints[i].position, b.joints[i].position, share);
        pose.joints[i].orientation =
            glm::normalize(glm::slerp(a.joints[i].orientation, b.joints[i].orientation, share));
    }
    return pose;
}

const HandPose& PoseBlend::step(const HandPose& seen, int stretch, float notSeen_s, float dt_s) {
    const bool known = stretch != 0 && notSeen_s <= kHandLost_s;
    if (!known) {
        pose_.tracked = false;
        pose_.confidence = glide_s_ = 0;
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
    pose_.confidence = seen.confidence * std::max(0.0f, 1 - notSeen_s / kHandLost_s);
    return pose_;
}

void HandSourceSelector::tick(const DeviceHands& device, std::array<HandPose, 2>& given, float ago_s,
                              float dt_s) {
    fromDevice_ = device.seesHands(kMouseReturns_s);
    everFromDevice_ |= fromDevice_;
    for (int side = 0; side < 2; ++side) {
        Hand& hand = hands_[side];
        HandPose& pose = given[side];
        if (!everFromDevice_) {
            hand.continuity.take(pose); // so that the first change of source is a glide too
            continue;
        }
        if (!fromDevice_) {
            hand.target = pose;
            hand.targetStretch = kMouse;
            pose = hand.continuity.step(hand.target, kMouse, 0, dt_s);
            continue;
        }
        const HandFilter& seen = device.hand(side);
        const float age_s = device.age_s(side) - ago_s;
        const JointPose palm = seen.palm(age_s);
        const Joint& filtered = seen.pose().joints[kPalmJoint];
        const HandPose newest = carried(seen.pose(), {filtered.position, filtered.orientation}, palm);
        const bool isNew = seen.pose().time_us != hand.target.time_us;
        hand.sinceFrame_s = isNew ? 0 : hand.sinceFrame_s + dt_s;
        if (seen.stretch() == hand.targetStretch) {
            // The longer correction keeps the hands of a slow device on their way until its next frame comes.
            const float slow_s = std::max(0.0f, seen.interval_s() - kStops_s / 2);
            const float left_s = std::max(seen.interval_s(), kCorrect_s) + slow_s - hand.sinceFrame_s;
            hand.target = between(carried(hand.target, seen.palm(age_s - dt_s), palm), newest,
                                  1 / std::max(left_s / dt_s, 1.0f));
        } else {
            hand.target = newest;
        }
        hand.targetStretch = seen.stretch();
        pose = hand.continuity.step(hand.target, seen.stretch(), device.notSeen_s(side), dt_s);
    }
}

} // namespace shoal::hands
