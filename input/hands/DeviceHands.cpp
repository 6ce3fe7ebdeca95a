#include "input/hands/DeviceHands.h"

namespace shoal::hands {

namespace {

constexpr std::chrono::milliseconds kPatience{2000};

} // namespace

bool DeviceHands::due(HandStream& stream, HandFrame& frame) {
    if (time_ == DeviceTime::Live) return stream.take(frame);
    if (!ahead_) {
        HandFrame next;
        if (!stream.take(next)) {
            if (silent_ || !stream.wait(kPatience) || !stream.take(next)) {
                silent_ = true;
                return false;
            }
        }
        silent_ = false;
        // A device's clock that starts, or starts anew, starts now.
        if (!begun_ || next.time_us < last_us_) gameFromDevice_us_ = game_us_ - next.time_us;
        begun_ = true;
        last_us_ = next.time_us;
        ahead_ = next;
    }
    if (ahead_->time_us + gameFromDevice_us_ > game_us_) return false;
    frame = *ahead_;
    ahead_.reset();
    return true;
}

void DeviceHands::advance(HandStream& stream, double elapsed_s) {
    game_us_ += static_cast<int64_t>(elapsed_s * 1e6);
    for (float& s : notSeen_s_) s += static_cast<float>(elapsed_s);
    HandFrame frame;
    while (due(stream, frame))
        for (size_t side = 0; side < 2; ++side) {
            filters_[side].step(frame.hands[side], frame.identity[side], frame.time_us);
            if (filters_[side].seen()) notSeen_s_[side] = 0;
        }
}

} // namespace shoal::hands
