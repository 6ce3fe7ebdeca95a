#include "input/hands/HandTracker.h"

#include <algorithm>
#include <utility>

namespace shoal::hands {

void HandStream::push(HandFrame frame) {
    if (frame.seenAt == Clock::time_point()) frame.seenAt = Clock::now();
    std::unique_lock lock(mutex_);
    if (waits_) changed_.wait(lock, [&] { return closed_ || frames_.size() < capacity_; });
    if (frames_.size() >= capacity_) frames_.pop_front();
    frames_.push_back(std::move(frame));
    changed_.notify_all();
}

bool HandStream::take(HandFrame& out, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    const auto ready = [&] { return closed_ || !frames_.empty(); };
    if (waits_ && patience.count() > 0)
        changed_.wait(lock, ready);
    else
        changed_.wait_for(lock, patience, ready);
    if (frames_.empty()) return false;
    out = frames_.front();
    frames_.pop_front();
    changed_.notify_all();
    return true;
}

float spanOf(const HandPose& hand) {
    const FingerJoints& middle = kFingerJoints[static_cast<size_t>(Finger::Middle)];
    const auto at = [&](int joint) { return hand.joints[joint].position; };
    float span_m = glm::distance(at(kPalmJoint), at(middle.proximal)) + hand.joints[middle.tip].radius;
    for (int joint = middle.proximal; joint < middle.tip; ++joint)
        span_m += glm::distance(at(joint), at(joint + 1));
    return span_m;
}

void HandPlacement::apply(std::array<HandPose, 2>& hands, int64_t time_us) {
    const bool both = hands[0].tracked && hands[1].tracked;
    if (both) {
        const glm::vec3 apart = hands[1].joints[kPalmJoint].position - hands[0].joints[kPalmJoint].position;
        const float touching_m = spanOf(hands[0]) + spanOf(hands[1]); // palms nearer than this may touch
        const float far = std::clamp((glm::length(apart) - touching_m) / kFull_m, 0.0f, 1.0f);
        const float lengthened = far * far * (3 - 2 * far);
        const glm::vec3 back = mount_.viewerFromDevice * apart * ((mount_.reach - 1) * (1 - lengthened) / 2);
        shifts_ = {back, -back};
    }
    const float step = std::clamp(static_cast<float>(time_us - time_us_) * 1e-6f / kEase_s, 0.0f, 1.0f);
    if (!seen_) // a hand that was not there cannot leap
        share_ = both ? 1.0f : 0.0f;
    else
        share_ = std::clamp(share_ + (both ? step : -step), 0.0f, 1.0f);
    seen_ = hands[0].tracked || hands[1].tracked;
    time_us_ = time_us;
    for (size_t i = 0; i < 2; ++i) {
        if (!hands[i].tracked) continue;
        mount_.apply(hands[i]);
        for (Joint& joint : hands[i].joints) joint.position += shifts_[i] * share_;
    }
}

void resize(HandPose& hand, float size) {
    for (Joint& joint : hand.joints) {
        joint.position *= size;
        joint.radius *= size;
    }
}

void HandSizing::begin(State state, float rigDistance_m) {
    *this = HandSizing();
    state_ = state;
    least_m_ = most_m_ = rigDistance_m;
}

void HandSizing::see(std::optional<float> rigDistance_m, float dt_s) {
    if (state_ == State::Done) return;
    if (!rigDistance_m) {
        missing_s_ += dt_s;
        if (missing_s_ >= kMissing_s) begin(State::Waiting);
        return;
    }
    missing_s_ = 0;
    const auto size = static_cast<double>(kAt_m / std::max(*rigDistance_m, 1e-3f));
    if (size < kHandSizeMin || size > kHandSizeMax) return begin(State::Elsewhere);
    if (state_ != State::Holding) begin(State::Holding, *rigDistance_m);
    least_m_ = std::min(least_m_, *rigDistance_m);
    most_m_ = std::max(most_m_, *rigDistance_m);
    if (most_m_ - least_m_ > kSpread * least_m_) begin(State::Holding, *rigDistance_m); // it moves
    sum_m_ += *rigDistance_m;
    ++seen_;
    held_s_ += dt_s;
    if (held_s_ >= kHold_s) state_ = State::Done;
}

std::optional<float> HandSizing::size() const {
    if (state_ != State::Done) return std::nullopt;
    return kAt_m * static_cast<float>(seen_) / sum_m_;
}

} // namespace shoal::hands
