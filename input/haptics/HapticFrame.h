// Vibration that the player should feel now, independent of the device; each driver reproduces what it can.
#pragma once

#include "engine/scene/HandPose.h"

#include <array>
#include <span>

namespace shoal::haptics {

// Five fingertips and the palm of the left hand, then of the right.
constexpr int kActuatorsPerHand = hands::kHandParts;
constexpr int kActuatorCount = 2 * kActuatorsPerHand;

constexpr std::array<const char*, kActuatorCount> kActuatorNames = {
    "left thumb",  "left index",  "left middle",  "left ring",  "left little",  "left palm",
    "right thumb", "right index", "right middle", "right ring", "right little", "right palm"};

struct Actuation {
    float amplitude = 0;      // 0 to 1
    float frequency_Hz = 160; // 10 to 500
};

struct HapticFrame {
    std::array<Actuation, kActuatorCount> actuators{}; // [hand * kActuatorsPerHand + finger]
    Actuation body;
};

// The two motors of a common controller, 0 to 1: a heavy slow one and a light quick one.
struct Motors {
    float strong = 0, weak = 0;
};

// Distributes actuations by frequency: up to 60 Hz to the strong motor, from 200 Hz to the weak one. The
// strongest of them counts, so that many fingers are not felt as one blow. NaN is 0.
Motors motorsOf(std::span<const Actuation> actuations);
Motors motorsOf(const HapticFrame& frame); // with the body

// Returns a hand's six actuators.
std::span<const Actuation> handOf(const HapticFrame& frame, int hand);

inline Actuation stronger(const Actuation& a, const Actuation& b) {
    return b.amplitude > a.amplitude ? b : a;
}

// Returns the drive of a motor with an eccentric weight, 0 to 1. Such motors start only at about a fifth of
// their range, so amplitudes above 0 are mapped to the rest of it.
float driveOf(float amplitude);

// Returns the vibration of a device with one motor a hand, such as a headset's controllers: the strongest of
// the hand's actuators and the body's. hand: 0 left, 1 right. Amplitude 0 to 1; NaN is 0.
Actuation vibrationOf(const HapticFrame& frame, int hand);

// Decides when to send to such a device: a change at once, an ongoing vibration again before it runs out.
class VibrationTimer {
  public:
    // Returns whether to send `now`. now_s: any clock that rises.
    bool due(const Actuation& now, double now_s);

  private:
    Actuation sent_{};
    double sent_s_ = -1e9;
};
constexpr double kVibrationAgain_s = 0.05; // half of the time for which a headset vibrates

} // namespace shoal::haptics
