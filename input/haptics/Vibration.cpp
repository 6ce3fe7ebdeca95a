#include "input/haptics/Vibration.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

Actuation vibrationOf(const HapticFrame& frame, int hand) {
    Actuation strongest{0, 0};
    for (int i = 0; i < kActuatorsPerHand; ++i) {
        const Actuation& one = frame.actuators[static_cast<size_t>(hand * kActuatorsPerHand + i)];
        if (one.amplitude > strongest.amplitude) strongest = one;
    }
    if (frame.body.amplitude > strongest.amplitude) strongest = frame.body;
    strongest.amplitude = std::min(strongest.amplitude, 1.0f);
    return strongest;
}

bool VibrationTimer::due(const Actuation& now, double now_s) {
    constexpr float kAmplitudeStep = 0.04f, kFrequencyStep_Hz = 8; // smaller steps are not felt
    const bool on = now.amplitude > 0, was = sent_.amplitude > 0;
    const bool news =
        on != was || (on && (std::abs(now.amplitude - sent_.amplitude) > kAmplitudeStep ||
                             std::abs(now.frequency_Hz - sent_.frequency_Hz) > kFrequencyStep_Hz));
    if (!news && !(on && now_s - sent_s_ >= kVibrationAgain_s)) return false;
    sent_ = now;
    sent_s_ = now_s;
    return true;
}

} // namespace shoal::haptics
