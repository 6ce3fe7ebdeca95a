// Haptic devices on a thread of their own: they come and go, and writing to them takes as long as it takes,
// without the picture noticing.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/HidBus.h"

#include <memory>

namespace shoal::haptics {

class HapticOutput {
  public:
    explicit HapticOutput(HidBus bus);
    HapticOutput(HapticOutput&&) noexcept;
    HapticOutput& operator=(HapticOutput&&) noexcept;
    ~HapticOutput(); // stops every motor

    // What to feel from now on; only the newest frame counts. One thread; neither waits nor allocates.
    void submit(const HapticFrame& frame);

    int ready() const; // devices being written to

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shoal::haptics
