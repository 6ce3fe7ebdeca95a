#include "input/haptics/HapticOutput.h"

#include "engine/core/Log.h"
#include "input/haptics/HapticDevices.h"

#include <algorithm>

namespace shoal::haptics {

namespace {

constexpr double kStopping_s = 0.1; // for the last reports, each at its device's pace

double secondsSince(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

} // namespace

HapticOutput::HapticOutput(HidBus bus)
    : thread_([this, bus = std::move(bus)](const std::stop_token& ending) { run(ending, bus); }) {}

void HapticOutput::submit(const HapticFrame& frame) {
    {
        const std::lock_guard lock(mutex_);
        newest_ = {frame, Clock::now()};
        fresh_ = true;
    }
    changed_.notify_one();
}

// The newest frame, once there is one or the time is over; empty when the output ends.
std::optional<HapticOutput::Submitted> HapticOutput::wait(const std::stop_token& ending, double max_s) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, ending, std::chrono::duration<double>(max_s), [&] { return fresh_; });
    fresh_ = false;
    return ending.stop_requested() ? std::nullopt : std::optional(newest_);
}

void HapticOutput::run(const std::stop_token& ending, const HidBus& bus) {
    HapticDevices hapticDevices(bus);
    const Clock::time_point began = Clock::now();
    for (double next_s = 0; const auto submitted = wait(ending, next_s);) {
        const double left_s = kFelt_s - secondsSince(submitted->when);
        next_s = hapticDevices.step(left_s > 0 ? submitted->frame : HapticFrame(), secondsSince(began));
        for (const std::string& warning : hapticDevices.takeWarnings()) log::warn("{}", warning);
        if (left_s > 0) next_s = std::min(next_s, left_s);
    }
    const Clock::time_point stopping = Clock::now();
    while (!hapticDevices.allStopped() && secondsSince(stopping) < kStopping_s) {
        const double next_s = hapticDevices.step({}, secondsSince(began));
        if (!hapticDevices.allStopped())
            std::this_thread::sleep_for(std::chrono::duration<double>(std::min(next_s, kStopping_s)));
    }
}

} // namespace shoal::haptics
