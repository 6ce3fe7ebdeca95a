// Haptic output on a thread of its own, so that neither finding devices nor slow writes delay a picture.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/HidBus.h"

#include <memory>

namespace shoal::haptics {

// A frame lasts that long unless a newer one comes: when the program stalls, the motors stop.
constexpr double kFelt_s = 0.25;

class HapticOutput {
  public:
    explicit HapticOutput(HidBus bus);
    HapticOutput(HapticOutput&&) noexcept;
    HapticOutput& operator=(HapticOutput&&) noexcept;
    ~HapticOutput(); // stops every motor; takes at most a few writings' time

    // What to feel from now on; only the newest frame counts. Does not allocate, and waits at most for the
    // copy of a frame. Written at once unless the device had its last report too short a time ago.
    void submit(const HapticFrame& frame);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shoal::haptics
