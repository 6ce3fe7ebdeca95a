// Drivers of the common game controllers with two or four motors.
#include "input/haptics/DeviceTable.h"
#include "input/haptics/HapticFrame.h"

#include <cmath>
#include <zlib.h>

namespace shoal::haptics {

namespace {

uint8_t scaled(float amplitude, float full) {
    return static_cast<uint8_t>(std::lround(driveOf(amplitude) * full));
}

// Adds the CRC-32 that Sony wants over Bluetooth, of the whole packet; 0xA2 is an output report's header.
void addSonyChecksum(Report& report) {
    constexpr uint8_t kHeader = 0xA2;
    constexpr size_t kAt = 74;
    uLong crc = crc32(0, &kHeader, 1);
    crc = crc32(crc, report.bytes.data(), kAt);
    for (size_t i = 0; i < 4; ++i) report.bytes[kAt + i] = static_cast<uint8_t>(crc >> (8 * i));
}

// Returns whether the newer bit enables vibration: from firmware 2.21 on, and on every DualSense Edge.
// Feature report 0x20 holds the firmware's version.
bool hasNewVibration(const DeviceContext& given) {
    constexpr uint16_t kEdge = 0x0df2, kFrom = 2 << 8 | 21;
    constexpr size_t kVersionAt = 44;
    if (given.product == kEdge) return true;
    std::array<uint8_t, 64> bytes{0x20};
    return given.device.readFeature(bytes) == bytes.size() &&
           (bytes[kVersionAt] | bytes[kVersionAt + 1] << 8) >= kFrom;
}

// Bytes: id; over Bluetooth also sequence number and 0x10 (for the controller itself, not its audio); enable
// 1 (bit 0: vibration, bit 1: haptics instead of audio); enable 2; right motor; left motor. Enable 3 (bit 2:
// vibration with new firmware) lies 38 bytes after enable 1.
Report dualSense(const HapticFrame& frame, bool bluetooth, bool newVibration) {
    const Motors motors = motorsOf(frame);
    Report report{.size = bluetooth ? 78u : 48u};
    const size_t at = bluetooth ? 3 : 1;
    report.bytes[0] = bluetooth ? 0x31 : 0x02;
    if (bluetooth) report.bytes[2] = 0x10;
    report.bytes[at] = newVibration ? 0x02 : 0x03;
    report.bytes[at + 2] = scaled(motors.weak, 255);
    report.bytes[at + 3] = scaled(motors.strong, 255);
    if (newVibration) report.bytes[at + 38] = 0x04;
    return report;
}

void sealDualSenseBluetooth(Report& report, uint8_t sequence) {
    report.bytes[1] = static_cast<uint8_t>(sequence << 4);
    addSonyChecksum(report);
}

// Bytes: id; over Bluetooth also 0xC0 (HID report with a checksum) and an unused one; enable (bit 0: rumble);
// two unused; right motor; left motor. The light and its blinking are not enabled.
Report dualShock4(const HapticFrame& frame, bool bluetooth) {
    const Motors motors = motorsOf(frame);
    Report report{.size = bluetooth ? 78u : 32u};
    const size_t at = bluetooth ? 3 : 1;
    report.bytes[0] = bluetooth ? 0x11 : 0x05;
    if (bluetooth) report.bytes[1] = 0xC0;
    report.bytes[at] = 0x01;
    report.bytes[at + 3] = scaled(motors.weak, 255);
    report.bytes[at + 4] = scaled(motors.strong, 255);
    return report;
}

void sealDualShock4Bluetooth(Report& report, uint8_t) { addSonyChecksum(report); }

// Bytes: id; motors to enable (all four); left trigger, right trigger, strong and weak motor, in per cent; on
// for 2.55 s; no pause; repeats, so that it runs until the next report. Each trigger serves a hand's fingers.
Report xbox(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    return {{0x03, 0x0F, scaled(motorsOf(handOf(frame, 0)).weak, 100),
             scaled(motorsOf(handOf(frame, 1)).weak, 100), scaled(motors.strong, 100),
             scaled(motors.weak, 100), 0xFF, 0, 0xEB},
            9};
}

// Appends the strengths of the strong and of the weak motor, 16 bits each, little-endian.
Report withMotors16(Report report, const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    for (const float amplitude : {motors.strong, motors.weak}) {
        const auto value = static_cast<uint16_t>(std::lround(driveOf(amplitude) * 65535));
        report.bytes[report.size++] = static_cast<uint8_t>(value);
        report.bytes[report.size++] = static_cast<uint8_t>(value >> 8);
    }
    return report;
}

Report stadia(const HapticFrame& frame) { return withMotors16({{0x05}, 1}, frame); }
Report forceFeedback(const HapticFrame& frame) { return withMotors16({}, frame); }

} // namespace

Driver makeDualSense(const DeviceContext& device) {
    const bool bluetooth = device.bluetooth, newVibration = hasNewVibration(device);
    return {.encode = [=](const HapticFrame& frame) { return dualSense(frame, bluetooth, newVibration); },
            .seal = bluetooth ? sealDualSenseBluetooth : nullptr};
}

Driver makeDualShock4(const DeviceContext& device) {
    const bool bluetooth = device.bluetooth;
    return {.encode = [=](const HapticFrame& frame) { return dualShock4(frame, bluetooth); },
            .seal = bluetooth ? sealDualShock4Bluetooth : nullptr};
}

Driver makeXbox(const DeviceContext&) { return {.encode = xbox}; }
Driver makeStadia(const DeviceContext&) { return {.encode = stadia}; }
Driver makeForceFeedback(const DeviceContext&) { return {.encode = forceFeedback}; }

} // namespace shoal::haptics
