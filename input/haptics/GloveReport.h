// The output report of the fingertip glove (content/glove/GLOVE.md). Plain C++17 without a library: the
// glove's firmware includes it too.
#pragma once

#include <cstddef>
#include <cstdint>

namespace glove {

constexpr uint16_t kUsagePage = 0xFF48; // vendor-defined; with the usage it names this report
constexpr uint8_t kUsage = 0x01;

constexpr int kActuators = 12; // thumb, index, middle, ring, little, palm; left hand, then right
constexpr size_t kReportBytes = 1 + kActuators + kActuators; // sequence, amplitudes, frequencies
constexpr uint32_t kHzPerStep = 2;                           // hertz for one step of a frequency's byte

} // namespace glove
