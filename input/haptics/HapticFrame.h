// Vibration that the player should feel now, independent of the device; each driver reproduces what it can.
#pragma once

#include "engine/scene/HandPose.h"

#include <array>

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

} // namespace shoal::haptics
