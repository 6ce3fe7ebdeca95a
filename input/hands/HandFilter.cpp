#include "input/hands/HandFilter.h"

#include "engine/math/Trigonometry.h"
#include "input/hands/HandRig.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

// Returns the displacement from a to b; for quaternions the shorter rotation, axis times angle in a's frame.
static glm::vec3 wayBetween(const glm::vec3& a, const glm::vec3& b) { return b - a; }
static glm::vec3 wayBetween(const glm::quat& a, const glm::quat& b) {
    glm::quat d = glm::conjugate(a) * b;
    if (d.w < 0) d = -d;
    const glm::vec3 v(d.x, d.y, d.z);
    const float sine = glm::length(v);
    if (sine < 1e-7f) return 2.0f * v;
    return v * (2 * std::atan2(sine, d.w) / sine);
}

static glm::vec3 moved(const glm::vec3& from, const glm::vec3& way) { return from + way; }
static glm::quat moved(const glm::quat& from, const glm::vec3& way) {
    const float angle = glm::length(way);
    if (angle < 1e-7f) return from;
    return glm::normalize(from * glm::angleAxis(angle, way / angle));
}

using namespace tuning;

template <class Value> void OneEuro<Value>::reset(const Value& value) {
    value_ = raw_ = value;
    speed_ = glm::vec3(0);
    lag_s_ = 0;
}

template <class Value> const Value& OneEuro<Value>::step(const Value& value, float dt_s) {
    if (!(dt_s > 0)) return value_;
    speed_ += (wayBetween(raw_, value) / dt_s - speed_) * smoothing(tuning_.speedCutoff_Hz, dt_s);
    raw_ = value;
    const float cutoff_Hz = tuning_.minCutoff_Hz + tuning_.slope * glm::length(speed_);
    const float share = smoothing(cutoff_Hz, dt_s);
    lag_s_ = dt_s * (1 - share) / share;
    return value_ = moved(value_, wayBetween(value_, value) * share);
}

template class OneEuro<glm::vec3>;
template class OneEuro<glm::quat>;

template <class Value> void DeadReckoning<Value>::step(const Value& from, const Value& to, float dt_s) {
    if (!(dt_s > 0)) return;
    const float before = glm::length(velocity_);
    const float cutoff_Hz = tuning_.minCutoff_Hz + tuning_.slope * before;
    velocity_ += (wayBetween(from, to) / dt_s - velocity_) * smoothing(cutoff_Hz, dt_s);
    const float now = glm::length(velocity_);
    used_ = now < before ? velocity_ * std::max(0.0f, 2 - before / std::max(now, 1e-9f)) : velocity_;
}

template <class Value> Value DeadReckoning<Value>::ahead(const Value& value, float ahead_s) const {
    const float t = std::clamp(ahead_s, -kStops_s, kStops_s);
    const glm::vec3 way = used_ * (t - t * t / (2 * kStops_s));
    const float length = glm::length(way);
    return moved(value, length > tuning_.farthest ? way * (tuning_.farthest / length) : way);
}

template class DeadReckoning<glm::vec3>;
template class DeadReckoning<glm::quat>;

Gesture GestureLatch::step(float& grip, float& pinch, float dt_s) {
    const float share = begun_ ? math::followShare(dt_s, kStrengthTau_s) : 1.0f;
    begun_ = true;
    grip_ += (std::clamp(grip, 0.0f, 1.0f) - grip_) * share;
    pinch_ += (std::clamp(pinch, 0.0f, 1.0f) - pinch_) * share;
    if (gesture_ == Gesture::Fist && grip_ < kGripOpens) gesture_ = Gesture::Open;
    if (gesture_ == Gesture::Pinch && grip_ > kPinchToFist) gesture_ = Gesture::Fist;
    if (gesture_ == Gesture::Pinch && pinch_ < kPinchOpens) gesture_ = Gesture::Open;
    if (gesture_ == Gesture::Open && grip_ > kGripCloses) gesture_ = Gesture::Fist;
    if (gesture_ == Gesture::Open && pinch_ > kPinchCloses) gesture_ = Gesture::Pinch;
    grip = gesture_ == Gesture::Fist ? std::max(grip_, kClosedMin) : std::min(grip_, kOpenMax);
    pinch = gesture_ == Gesture::Pinch ? std::max(pinch_, kClosedMin) : std::min(pinch_, kOpenMax);
    return gesture_;
}

HandPose carried(const HandPose& hand, const JointPose& from, const JointPose& to) {
    const glm::quat turn = to.orientation * glm::conjugate(from.orientation);
    HandPose pose = hand;
    for (Joint& joint : pose.joints) {
        joint.position = to.position + turn * (joint.position - from.position);
        joint.orientation = glm::normalize(turn * joint.orientation);
    }
    return pose;
}

JointPose HandFilter::palm(float after_s) const {
    return {palmMotion_.ahead(palm_.value(), after_s + palm_.lag_s()),
            palmSpin_.ahead(palmTurn_.value(), after_s + palmTurn_.lag_s())};
}

void HandFilter::step(const HandPose& seen, int64_t identity, int64_t time_us) {
    if (!seen.tracked || !plausible(seen)) {
        pose_.tracked = false;
        return;
    }
    float dt_s = static_cast<float>(time_us - raw_.time_us) * 1e-6f;
    const bool goesOn =
        pose_.tracked && identity == identity_ && dt_s >= 0 && dt_s <= kHandLost_s &&
        glm::distance(seen.joints[0].position, raw_.joints[0].position) < kJump_m + kFastest_mps * dt_s;
    if (!goesOn) dt_s = 0; // every filter begins anew
    interval_s_ = dt_s;
    raw_ = seen;
    raw_.time_us = time_us;
    identity_ = identity;
    const auto filtered = [&](auto& filter, const auto& value) {
        if (!goesOn) filter.reset(value);
        return filter.step(value, dt_s);
    };

    const Joint& palm = seen.joints[0];
    const glm::quat palmFromView = glm::conjugate(palm.orientation);
    if (!goesOn) {
        ++stretch_;
        latch_ = {};
        palmMotion_.reset();
        palmSpin_.reset();
    }
    const JointPose before{palm_.value(), palmTurn_.value()};
    const glm::vec3 palmAt = filtered(palm_, palm.position);
    const glm::quat palmTurn = filtered(palmTurn_, palm.orientation);
    palmMotion_.step(before.position, palmAt, dt_s);
    palmSpin_.step(before.orientation, palmTurn, dt_s);

    pose_ = raw_;
    for (int i = 0; i < kJointCount; ++i) {
        const Joint& joint = seen.joints[i];
        pose_.joints[i].position =
            palmAt + palmTurn * filtered(palmFromJoint_[i], palmFromView * (joint.position - palm.position));
        pose_.joints[i].orientation =
            glm::normalize(palmTurn * filtered(palmFromJointTurn_[i], palmFromView * joint.orientation));
    }
    // The filter shortens bones in curved motion. The palm stays; the wrist and the joints below it follow.
    const auto keepLength = [&](int from, int to) {
        const float length = glm::distance(seen.joints[from].position, seen.joints[to].position);
        const glm::vec3 bone = pose_.joints[to].position - pose_.joints[from].position;
        const float now = glm::length(bone);
        if (now > 1e-5f) pose_.joints[to].position = pose_.joints[from].position + bone * (length / now);
    };
    keepLength(0, 1);
    for (int i = 2; i < kJointCount; ++i) keepLength(kJointParent[i], i);
    gesture_ = latch_.step(pose_.grip, pose_.pinch, dt_s);
}

} // namespace shoal::hands
