#include "input/haptics/Gamepads.h"

#include "input/haptics/Motors.h"

#include <algorithm>
#include <cmath>
#include <zlib.h>

namespace shoal::haptics {

namespace {

uint8_t scaled(float amplitude, float full) {
    return static_cast<uint8_t>(std::lround(driveOf(amplitude) * full));
}

// The DualSense's own structure, from `at` on: enable 1 (bit 0 vibration, bit 1 haptics instead of audio),
// enable 2, right motor, left motor; enable 3 (bit 2 vibration, new firmware) at 38.
Report dualSense(const HapticFrame& frame, size_t size, size_t at, bool newFirmware) {
    const Motors motors = motorsOf(frame);
    Report report{.size = size};
    report.bytes[at] = newFirmware ? 0x02 : 0x03;
    report.bytes[at + 2] = scaled(motors.weak, 255);
    report.bytes[at + 3] = scaled(motors.strong, 255);
    if (newFirmware) report.bytes[at + 38] = 0x04;
    return report;
}

Report dualSenseUsb(const HapticFrame& frame, bool newFirmware) {
    Report report = dualSense(frame, 48, 1, newFirmware);
    report.bytes[0] = 0x02;
    return report;
}

Report dualSenseBluetooth(const HapticFrame& frame, bool newFirmware) {
    Report report = dualSense(frame, 78, 3, newFirmware);
    report.bytes[0] = 0x31;
    report.bytes[2] = 0x10; // a report for the controller itself, not its audio
    return report;
}

// Over Bluetooth Sony wants a CRC-32 of the whole packet; A2 is the Bluetooth header of an output report.
void addSonyChecksum(Report& report) {
    constexpr uint8_t kHeader = 0xA2;
    constexpr size_t kAt = 74;
    uLong crc = crc32(0, &kHeader, 1);
    crc = crc32(crc, report.bytes.data(), kAt);
    for (size_t i = 0; i < 4; ++i) report.bytes[kAt + i] = static_cast<uint8_t>(crc >> (8 * i));
}

} // namespace

Report encodeDualSenseUsb(const HapticFrame& frame) { return dualSenseUsb(frame, false); }
Report encodeDualSenseUsbNew(const HapticFrame& frame) { return dualSenseUsb(frame, true); }
Report encodeDualSenseBluetooth(const HapticFrame& frame) { return dualSenseBluetooth(frame, false); }
Report encodeDualSenseBluetoothNew(const HapticFrame& frame) { return dualSenseBluetooth(frame, true); }

void sealDualSenseBluetooth(Report& report, uint8_t sequence) {
    report.bytes[1] = static_cast<uint8_t>(sequence << 4);
    addSonyChecksum(report);
}

// id, enable (bit 0 rumble), two unused, right motor, left motor; light and blink not enabled.
Report encodeDualShock4Usb(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    Report report{.size = 32};
    report.bytes[0] = 0x05;
    report.bytes[1] = 0x01;
    report.bytes[4] = scaled(motors.weak, 255);
    report.bytes[5] = scaled(motors.strong, 255);
    return report;
}

// id, C0 (a HID report with a checksum), an unused byte, and then as over USB.
Report encodeDualShock4Bluetooth(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    Report report{.size = 78};
    report.bytes[0] = 0x11;
    report.bytes[1] = 0xC0;
    report.bytes[3] = 0x01;
    report.bytes[6] = scaled(motors.weak, 255);
    report.bytes[7] = scaled(motors.strong, 255);
    return report;
}

void sealDualShock4Bluetooth(Report& report, uint8_t) { addSonyChecksum(report); }

// id, motors meant (all four), left trigger, right trigger, strong, weak in per cent; on for 2.55 s, no
// pause, repeated: it runs until it is told otherwise.
Report encodeXboxBluetooth(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    Report report{.size = 9};
    report.bytes[0] = 0x03;
    report.bytes[1] = 0x0F;
    report.bytes[2] = scaled(motorsOf(handOf(frame, 0)).weak, 100);
    report.bytes[3] = scaled(motorsOf(handOf(frame, 1)).weak, 100);
    report.bytes[4] = scaled(motors.strong, 100);
    report.bytes[5] = scaled(motors.weak, 100);
    report.bytes[6] = 0xFF;
    report.bytes[8] = 0xEB;
    return report;
}

// id, strong, weak: 16 bits each, little end first.
Report encodeStadia(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    Report report{.size = 5};
    report.bytes[0] = 0x05;
    const auto put = [&](size_t at, float amplitude) {
        const auto value = static_cast<uint16_t>(std::lround(driveOf(amplitude) * 65535));
        report.bytes[at] = static_cast<uint8_t>(value);
        report.bytes[at + 1] = static_cast<uint8_t>(value >> 8);
    };
    put(1, motors.strong);
    put(3, motors.weak);
    return report;
}

} // namespace shoal::haptics
