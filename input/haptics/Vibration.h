// For devices with one motor a hand, such as a headset's controllers.
#pragma once

#include "input/haptics/HapticFrame.h"

namespace shoal::haptics {

// The strongest of a hand's actuators and the body's, so that many fingers are not felt as one blow. hand: 0
// left, 1 right. Amplitude 0 to 1; what is no number is nothing.
Actuation vibrationOf(const HapticFrame& frame, int hand);

// Tells what a motor must be told when: news at once, what goes on again before it would run out.
class VibrationTimer {
  public:
    // Whether to send `now`. now_s: any clock that rises.
    bool due(const Actuation& now, double now_s);

  private:
    Actuation sent_{};
    double sent_s_ = -1e9;
};
constexpr double kVibrationAgain_s = 0.05; // half of what a headset is asked to vibrate for

} // namespace shoal::haptics
