// Haptic output on a thread of its own, so that neither finding devices nor slow writes delay a picture.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/HidBus.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace shoal::haptics {

// A frame lasts that long unless a newer one comes: when the program stalls, the motors stop.
constexpr double kFelt_s = 0.25;

// At its end it stops every motor, which takes at most a few writings' time.
class HapticOutput {
  public:
    explicit HapticOutput(HidBus bus);

    // What to feel from now on; only the newest frame counts. Does not allocate, and waits at most for the
    // copy of a frame. Written at once unless the device had its last report too short a time ago.
    void submit(const HapticFrame& frame);

  private:
    using Clock = std::chrono::steady_clock;
    struct Submitted {
        HapticFrame frame;
        Clock::time_point when{};
    };
    std::optional<Submitted> wait(const std::stop_token& ending, double max_s);
    void run(const std::stop_token& ending, const HidBus& bus);

    std::mutex mutex_; // of the following; held for a copy of one frame at a time
    std::condition_variable_any changed_;
    Submitted newest_;
    bool fresh_ = false;

    std::jthread thread_; // last: it uses all of the above
};

} // namespace shoal::haptics
