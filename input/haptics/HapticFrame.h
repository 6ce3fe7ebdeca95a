// What the player should feel now, for every device alike. A device keeps what it can show.
#pragma once

#include <array>

namespace shoal::haptics {

// Five fingertips and the palm of the left hand, then of the right.
constexpr int kActuatorsPerHand = 6;
constexpr int kActuatorCount = 2 * kActuatorsPerHand;
constexpr int kPalm = 5; // index within a hand, after thumb, index, middle, ring, little

struct Actuation {
    float amplitude = 0;      // 0 to 1
    float frequency_Hz = 160; // 10 to 500
};

struct HapticFrame {
    std::array<Actuation, kActuatorCount> actuators{}; // [hand * kActuatorsPerHand + finger]
};

} // namespace shoal::haptics
