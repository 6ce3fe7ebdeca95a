#include "input/hands/HandTracker.h"

#include <utility>

namespace shoal::hands {

HandStream::HandStream(size_t capacity, Full full) : capacity_(capacity), full_(full) {}

void HandStream::push(const HandFrame& frame) {
    std::unique_lock lock(mutex_);
    if (full_ == Full::Wait) changed_.wait(lock, [&] { return closed_ || frames_.size() < capacity_; });
    if (frames_.size() >= capacity_) frames_.pop_front();
    frames_.push_back(frame);
    changed_.notify_all();
}

bool HandStream::take(HandFrame& out, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return closed_ || !frames_.empty(); });
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

} // namespace shoal::hands
