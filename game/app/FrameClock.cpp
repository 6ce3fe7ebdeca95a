#include "game/app/FrameClock.h"

#include <algorithm>
#include <thread>

namespace shoal::app {

namespace {

constexpr double kMaxFrame_s = 0.5; // more is not made up for

double secondsSince(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

} // namespace

void FrameClock::beginFrame() {
    const Clock::time_point now = Clock::now();
    if (begun_)
        ++frame_;
    else
        start_ = frameStart_ = now;
    begun_ = true;
    wall_s_ = std::chrono::duration<double>(now - frameStart_).count();
    frameStart_ = now;
}

double FrameClock::sinceBegin_ms() const { return secondsSince(frameStart_) * 1e3; }

double FrameClock::elapsed_s(std::optional<double> display) const {
    if (display) return std::min(*display, kMaxFrame_s);
    if (mode_ == Mode::RealTime) return std::min(wall_s_, kMaxFrame_s);
    return frame_ == 0 ? 0 : 1 / fps_;
}

double FrameClock::video_s(double dive_s) const {
    return mode_ == Mode::TimeDemo ? secondsSince(start_) : dive_s;
}

void FrameClock::waitForLiveVideo() const {
    if (mode_ != Mode::FixedStep) return;
    const std::chrono::duration<double> due(static_cast<double>(frame_ + 1) / fps_);
    std::this_thread::sleep_until(start_ + std::chrono::duration_cast<Clock::duration>(due));
}

void FrameClock::waste(double load_ms) const {
    while (sinceBegin_ms() < load_ms) {
    }
}

} // namespace shoal::app
