#include "input/hands/HandTracker.h"

#include <algorithm>
#include <utility>

namespace shoal::hands {

Path handModelScript() { return dataRoot() / "input/hands/webcam/get_models"; }
Path handModelFolder() { return dataFolder() / "models"; }

void HandStream::push(HandFrame frame) {
    if (frame.seenAt == Clock::time_point()) frame.seenAt = Clock::now();
    std::unique_lock lock(mutex_);
    if (full_ == Full::Wait) changed_.wait(lock, [&] { return closed_ || frames_.size() < capacity_; });
    if (frames_.size() >= capacity_) frames_.pop_front();
    frames_.push_back(std::move(frame));
    changed_.notify_all();
}

bool HandStream::take(HandFrame& out, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    const auto ready = [&] { return closed_ || !frames_.empty(); };
    if (full_ == Full::Wait && patience.count() > 0)
        changed_.wait(lock, ready);
    else
        changed_.wait_for(lock, patience, ready);
    if (frames_.empty()) return false;
    out = frames_.front();
    frames_.pop_front();
    changed_.notify_all();
    return true;
}

void HandStream::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
}

void HandStream::setState(DeviceState state) {
    const std::lock_guard lock(mutex_);
    state_ = std::move(state);
}

DeviceState HandStream::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
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

} // namespace shoal::hands
