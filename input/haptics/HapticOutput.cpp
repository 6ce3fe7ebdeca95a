#include "input/haptics/HapticOutput.h"

#include "engine/core/Log.h"
#include "input/haptics/HapticDevices.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace shoal::haptics {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kStopping_s = 0.1; // for the last reports, each at its device's pace

struct Submitted {
    HapticFrame frame;
    Clock::time_point when{};
};

double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

} // namespace

// The mutex is held for a copy of one frame at a time.
struct HapticOutput::State {
    std::mutex mutex;
    std::condition_variable changed;
    Submitted newest;
    bool fresh = false, stop = false;
    std::thread thread;

    explicit State(HidBus bus) {
        thread = std::thread([this, bus = std::move(bus)] { run(bus); });
    }
    ~State() {
        {
            const std::lock_guard lock(mutex);
            stop = true;
        }
        changed.notify_one();
        thread.join();
    }

    void submit(const HapticFrame& frame) {
        {
            const std::lock_guard lock(mutex);
            newest = {frame, Clock::now()};
            fresh = true;
        }
        changed.notify_one();
    }

    // The newest frame, once there is one or the time is over; empty when the output ends.
    std::optional<Submitted> wait(double max_s) {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, std::chrono::duration<double>(max_s), [&] { return fresh || stop; });
        fresh = false;
        return stop ? std::nullopt : std::optional(newest);
    }

    void run(const HidBus& bus) {
        HapticDevices hapticDevices(bus);
        const Clock::time_point began = Clock::now();
        for (double next_s = 0; const auto submitted = wait(next_s);) {
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
};

HapticOutput::HapticOutput(HidBus bus) : state_(std::make_unique<State>(std::move(bus))) {}
HapticOutput::HapticOutput(HapticOutput&&) noexcept = default;
HapticOutput& HapticOutput::operator=(HapticOutput&&) noexcept = default;
HapticOutput::~HapticOutput() = default;

void HapticOutput::submit(const HapticFrame& frame) { state_->submit(frame); }

} // namespace shoal::haptics
