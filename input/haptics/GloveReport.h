// HID output report of the fingertip glove (content/glove/GLOVE.md). Plain C++17 without a library, because
// the glove's firmware includes this file too.
#pragma once

#include <cstddef>
#include <cstdint>

namespace glove {

constexpr uint16_t kUsagePage = 0xFF48; // vendor-defined; page and usage identify this report
constexpr uint8_t kUsage = 0x01;

constexpr int kActuators = 12; // thumb, index, middle, ring, little, palm; left hand, then right
constexpr size_t kReportBytes = 1 + kActuators + kActuators; // sequence, amplitudes, frequencies
constexpr uint32_t kHzPerStep = 2;                           // unit of a frequency byte

} // namespace glove
