#include "input/haptics/Controllers.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

namespace {

constexpr float kLow_Hz = 60, kHigh_Hz = 200;
constexpr float kLeastFelt = 0.2f; // of a motor's range

constexpr std::array<Controller, 5> kControllers = {{
    {0x054c, 0x0ce6, "DualSense", encodeDualSenseUsb},
    {0x054c, 0x0df2, "DualSense Edge", encodeDualSenseUsb},
    {0x054c, 0x05c4, "DualShock 4", encodeDualShock4Usb},
    {0x054c, 0x09cc, "DualShock 4", encodeDualShock4Usb},
    {0x054c, 0x0ba0, "DualShock 4 wireless adaptor", encodeDualShock4Usb},
}};

uint8_t driveOf(float amplitude) {
    if (!(amplitude > 1.0f / 512)) return 0; // NaN too
    const float drive = kLeastFelt + (1 - kLeastFelt) * std::min(amplitude, 1.0f);
    return static_cast<uint8_t>(std::lround(drive * 255));
}

} // namespace

Motors motorsOf(const HapticFrame& frame) {
    float strong = 0, weak = 0;
    for (const Actuation& actuation : frame.actuators) {
        const float quick = std::clamp((actuation.frequency_Hz - kLow_Hz) / (kHigh_Hz - kLow_Hz), 0.0f, 1.0f);
        strong = std::max(strong, actuation.amplitude * (1 - quick));
        weak = std::max(weak, actuation.amplitude * quick);
    }
    return {driveOf(strong), driveOf(weak)};
}

// id, enable 1 (bit 0 vibration, bit 1 haptics instead of audio), enable 2, right motor, left motor, the rest
// unused.
Report encodeDualSenseUsb(const Motors& motors) {
    Report report{.size = 48};
    report.bytes[0] = 0x02;
    report.bytes[1] = 0x03;
    report.bytes[3] = motors.weak;
    report.bytes[4] = motors.strong;
    return report;
}

// id, enable (bit 0 rumble), two unused, right motor, left motor, light and blink not enabled.
Report encodeDualShock4Usb(const Motors& motors) {
    Report report{.size = 32};
    report.bytes[0] = 0x05;
    report.bytes[1] = 0x01;
    report.bytes[4] = motors.weak;
    report.bytes[5] = motors.strong;
    return report;
}

std::span<const Controller> controllers() { return kControllers; }

const Controller* findController(uint16_t vendor, uint16_t product) {
    for (const Controller& controller : kControllers)
        if (controller.vendor == vendor && controller.product == product) return &controller;
    return nullptr;
}

} // namespace shoal::haptics
