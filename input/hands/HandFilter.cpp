#include "input/hands/HandFilter.h"

#include "input/hands/HandRig.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal::hands {

namespace {

using namespace tuning;

template <class Filter, size_t... I>
std::array<Filter, sizeof...(I)> each(const OneEuroTuning& tuning, std::index_sequence<I...>) {
    return {((void)I, Filter(tuning))...};
}

template <class Filter> std::array<Filter, kJointCount> perJoint(const OneEuroTuning& tuning) {
    return each<Filter>(tuning, std::make_index_sequence<kJointCount>());
}

} // namespace

Gesture GestureLatch::step(float& grip, float& pinch, float dt_s) {
    const float share = begun_ ? 1 - std::exp(-std::max(dt_s, 0.0f) / kStrengthTau_s) : 1.0f;
    begun_ = true;
    grip_ += (std::clamp(grip, 0.0f, 1.0f) - grip_) * share;
    pinch_ += (std::clamp(pinch, 0.0f, 1.0f) - pinch_) * share;
    switch (gesture_) {
    case Gesture::Fist:
        if (grip_ < kGripOpens) gesture_ = Gesture::Open;
        break;
    case Gesture::Pinch:
        if (grip_ > kPinchToFist)
            gesture_ = Gesture::Fist;
        else if (pinch_ < kPinchOpens)
            gesture_ = Gesture::Open;
        break;
    case Gesture::Open:
        break;
    }
    if (gesture_ == Gesture::Open) {
        if (grip_ > kGripCloses)
            gesture_ = Gesture::Fist;
        else if (pinch_ > kPinchCloses)
            gesture_ = Gesture::Pinch;
    }
    grip = gesture_ == Gesture::Fist ? std::max(grip_, kClosedMin) : std::min(grip_, kOpenMax);
    pinch = gesture_ == Gesture::Pinch ? std::max(pinch_, kClosedMin) : std::min(pinch_, kOpenMax);
    return gesture_;
}

HandFilter::HandFilter()
    : palm_(kPosition), palmTurn_(kOrientation), palmFromJoint_(perJoint<OneEuroPoint>(kFinger)),
      palmFromJointTurn_(perJoint<OneEuroTurn>(kOrientation)) {}

bool HandFilter::continues(const HandPose& seen, int64_t identity, float dt_s) const {
    return pose_.tracked && identity == identity_ && dt_s >= 0 && dt_s <= kGap_s &&
           glm::distance(seen.joints[0].position, raw_.joints[0].position) < kJump_m + kFastest_mps * dt_s;
}

void HandFilter::step(const HandPose& seen, int64_t identity, int64_t time_us) {
    if (!seen.tracked || !plausible(seen)) {
        pose_.tracked = false;
        return;
    }
    const float dt_s = static_cast<float>(time_us - raw_.time_us) * 1e-6f;
    const bool goesOn = continues(seen, identity, dt_s);
    raw_ = seen;
    raw_.time_us = time_us;
    identity_ = identity;

    const Joint& palm = seen.joints[0];
    const glm::quat palmFromView = glm::conjugate(palm.orientation);
    if (!goesOn) {
        ++stretch_;
        latch_.reset();
        palm_.reset(palm.position);
        palmTurn_.reset(palm.orientation);
    }
    const glm::vec3 palmAt = goesOn ? palm_.step(palm.position, dt_s) : palm.position;
    const glm::quat palmTurn = goesOn ? palmTurn_.step(palm.orientation, dt_s) : palm.orientation;

    pose_ = raw_;
    for (int i = 0; i < kJointCount; ++i) {
        const Joint& joint = seen.joints[i];
        const glm::vec3 offset = palmFromView * (joint.position - palm.position);
        const glm::quat turn = palmFromView * joint.orientation;
        if (!goesOn) {
            palmFromJoint_[i].reset(offset);
            palmFromJointTurn_[i].reset(turn);
        } else {
            palmFromJoint_[i].step(offset, dt_s);
            palmFromJointTurn_[i].step(turn, dt_s);
        }
        pose_.joints[i].position = palmAt + palmTurn * palmFromJoint_[i].value();
        pose_.joints[i].orientation = glm::normalize(palmTurn * palmFromJointTurn_[i].value());
    }
    // The filter cuts corners, and so bones. The palm stays; the wrist and what hangs from it follow.
    const auto keepLength = [&](int from, int to) {
        const float length = glm::distance(seen.joints[from].position, seen.joints[to].position);
        const glm::vec3 bone = pose_.joints[to].position - pose_.joints[from].position;
        const float now = glm::length(bone);
        if (now > 1e-5f) pose_.joints[to].position = pose_.joints[from].position + bone * (length / now);
    };
    keepLength(0, 1);
    for (int i = 2; i < kJointCount; ++i) keepLength(kJointParent[i], i);
    gesture_ = latch_.step(pose_.grip, pose_.pinch, goesOn ? dt_s : 0);
}

} // namespace shoal::hands
