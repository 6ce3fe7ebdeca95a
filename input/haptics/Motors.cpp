#include "input/haptics/HapticFrame.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

constexpr float kLow_Hz = 60, kHigh_Hz = 200;
constexpr float kMinFelt = 0.2f; // share of a motor's range at which it starts

Motors motorsOf(std::span<const Actuation> actuations) {
    Motors motors;
    for (const Actuation& each : actuations) {
        const float quick = std::clamp((each.frequency_Hz - kLow_Hz) / (kHigh_Hz - kLow_Hz), 0.0f, 1.0f);
        motors.strong = std::max(motors.strong, each.amplitude * (1 - quick)); // this order drops NaN
        motors.weak = std::max(motors.weak, each.amplitude * quick);
    }
    return motors;
}

Motors motorsOf(const HapticFrame& frame) {
    const Motors hands = motorsOf(frame.actuators), body = motorsOf({&frame.body, 1});
    return {std::max(hands.strong, body.strong), std::max(hands.weak, body.weak)};
}

std::span<const Actuation> handOf(const HapticFrame& frame, int hand) {
    return std::span(frame.actuators)
        .subspan(static_cast<size_t>(hand) * kActuatorsPerHand, kActuatorsPerHand);
}

Actuation strongestOf(const HapticFrame& frame, int hand, float min_Hz, float limit_Hz) {
    Actuation best;
    const auto compare = [&](const Actuation& each) {
        if (each.frequency_Hz >= min_Hz && each.frequency_Hz < limit_Hz) best = stronger(best, each);
    };
    std::ranges::for_each(handOf(frame, hand), compare);
    compare(frame.body);
    return best;
}

float driveOf(float amplitude) {
    if (!(amplitude > 1.0f / 512)) return 0; // NaN too
    return kMinFelt + (1 - kMinFelt) * std::min(amplitude, 1.0f);
}

Actuation vibrationOf(const HapticFrame& frame, int hand) {
    Actuation strongest = strongestOf(frame, hand);
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
