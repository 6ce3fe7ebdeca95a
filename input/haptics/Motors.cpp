#include "input/haptics/Motors.h"

#include <algorithm>

namespace shoal::haptics {

namespace {

constexpr float kLow_Hz = 60, kHigh_Hz = 200;
constexpr float kLeastFelt = 0.2f; // of a motor's range

void add(Motors& motors, const Actuation& actuation) {
    const float quick = std::clamp((actuation.frequency_Hz - kLow_Hz) / (kHigh_Hz - kLow_Hz), 0.0f, 1.0f);
    motors.strong = std::max(motors.strong, actuation.amplitude * (1 - quick)); // in this order NaN is lost
    motors.weak = std::max(motors.weak, actuation.amplitude * quick);
}

template <class Wanted> Actuation strongest(std::span<const Actuation> actuations, Wanted wanted) {
    Actuation best;
    for (const Actuation& actuation : actuations)
        if (actuation.amplitude > best.amplitude && wanted(actuation.frequency_Hz)) best = actuation;
    return best;
}

} // namespace

Motors motorsOf(std::span<const Actuation> actuations) {
    Motors motors;
    for (const Actuation& actuation : actuations) add(motors, actuation);
    return motors;
}

Motors motorsOf(const HapticFrame& frame) {
    Motors motors = motorsOf(frame.actuators);
    add(motors, frame.body);
    return motors;
}

std::span<const Actuation> handOf(const HapticFrame& frame, int hand) {
    return std::span(frame.actuators)
        .subspan(static_cast<size_t>(hand) * kActuatorsPerHand, kActuatorsPerHand);
}

Actuation strongestFrom(std::span<const Actuation> actuations, float least_Hz) {
    return strongest(actuations, [&](float frequency_Hz) { return frequency_Hz >= least_Hz; });
}

Actuation strongestBelow(std::span<const Actuation> actuations, float limit_Hz) {
    return strongest(actuations, [&](float frequency_Hz) { return frequency_Hz < limit_Hz; });
}

float driveOf(float amplitude) {
    if (!(amplitude > 1.0f / 512)) return 0; // NaN too
    return kLeastFelt + (1 - kLeastFelt) * std::min(amplitude, 1.0f);
}

} // namespace shoal::haptics
