// Drivers of haptic devices, which turn a frame into the bytes of an output report, on the thread of
// HapticOutput; and the table of devices: identification, description, driver and pace. Recognition, the list
// of `shoal devices` and the tests of bytes and of udev rules follow from it.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/HidBus.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace shoal::haptics {

constexpr size_t kMaxReportBytes = 78;

// A report as hidapi sends it: the id first.
struct Report {
    std::array<uint8_t, kMaxReportBytes> bytes{};
    size_t size = 0;

    std::span<const uint8_t> view() const { return std::span(bytes).first(size); }
    bool operator==(const Report&) const = default;
};

struct Driver {
    // Encodes a frame as a report. Equal reports mean equal vibration: seal adds what differs from one write
    // to the next (a sequence number, a checksum).
    std::function<Report(const HapticFrame&)> encode;
    void (*seal)(Report&, uint8_t sequence) = nullptr;
    std::vector<Report> initialReports; // written first, sealed likewise

    Report sealed(Report report, uint8_t sequence) const {
        if (seal) seal(report, sequence);
        return report;
    }
};

// Functions that make the driver of an open device.
using MakeDriver = Driver(const HidInfo&, HidDevice&);
MakeDriver makeDualSense, makeDualShock4, makeXbox, makeStadia, makeSwitch, makeGlove, makeForceFeedback;

struct DeviceRow {
    uint16_t vendor, product;
    Transport transport; // Any: USB and Bluetooth alike
    const char* name;
    const char* motors;
    MakeDriver* driver;
    double minWrite_s; // least time between two writes
    double refresh_s;  // time after which a vibration is repeated: some devices stop by themselves
};

// The pace on USB is that of the controllers' polling, 4 ms; over Bluetooth reports that come more often than
// every 10 ms queue up before the radio. Nintendo's voice coils fall silent after about 60 ms.
inline constexpr auto kDevices = [] {
    constexpr auto Usb = Transport::Usb, Bluetooth = Transport::Bluetooth, Any = Transport::Any;
    constexpr const char *kTwo = "a strong and a quick motor", *kCoils = "a voice coil in each hand",
                         *kOneCoil = "a voice coil",
                         *kFour = "a strong and a quick motor, one behind each trigger";
    return std::to_array<DeviceRow>({
        {0x054c, 0x0ce6, Usb, "DualSense", kTwo, makeDualSense, 0.004, 0.5},
        {0x054c, 0x0ce6, Bluetooth, "DualSense", kTwo, makeDualSense, 0.010, 0.5},
        {0x054c, 0x0df2, Usb, "DualSense Edge", kTwo, makeDualSense, 0.004, 0.5},
        {0x054c, 0x0df2, Bluetooth, "DualSense Edge", kTwo, makeDualSense, 0.010, 0.5},
        {0x054c, 0x05c4, Usb, "DualShock 4", kTwo, makeDualShock4, 0.004, 0.5},
        {0x054c, 0x05c4, Bluetooth, "DualShock 4", kTwo, makeDualShock4, 0.010, 0.5},
        {0x054c, 0x09cc, Usb, "DualShock 4", kTwo, makeDualShock4, 0.004, 0.5},
        {0x054c, 0x09cc, Bluetooth, "DualShock 4", kTwo, makeDualShock4, 0.010, 0.5},
        {0x054c, 0x0ba0, Usb, "DualShock 4 wireless adaptor", kTwo, makeDualShock4, 0.004, 0.5},
        {0x057e, 0x2009, Any, "Switch Pro Controller", kCoils, makeSwitch, 0.030, 0.050},
        {0x057e, 0x2006, Any, "Joy-Con L", kOneCoil, makeSwitch, 0.030, 0.050},
        {0x057e, 0x2007, Any, "Joy-Con R", kOneCoil, makeSwitch, 0.030, 0.050},
        {0x057e, 0x200e, Any, "Joy-Con grip", kCoils, makeSwitch, 0.030, 0.050},
        {0x045e, 0x02e0, Bluetooth, "Xbox One S controller", kFour, makeXbox, 0.010, 0.5},
        {0x045e, 0x02fd, Bluetooth, "Xbox One S controller", kFour, makeXbox, 0.010, 0.5},
        {0x045e, 0x0b20, Bluetooth, "Xbox One S controller", kFour, makeXbox, 0.010, 0.5},
        {0x045e, 0x0b13, Bluetooth, "Xbox Series controller", kFour, makeXbox, 0.010, 0.5},
        {0x045e, 0x0b05, Bluetooth, "Xbox Elite 2 controller", kFour, makeXbox, 0.010, 0.5},
        {0x045e, 0x0b22, Bluetooth, "Xbox Elite 2 controller", kFour, makeXbox, 0.010, 0.5},
        {0x18d1, 0x9400, Any, "Stadia controller", kTwo, makeStadia, 0.010, 0.5},
    });
}();

// A glove is known by its usage, whoever built it. Its watchdog waits 0.1 s.
inline constexpr DeviceRow kGlove = {
    0, 0, Transport::Any, "fingertip glove", "ten fingertips and two palms", makeGlove, 0.002, 0.040};

// Gamepads that the kernel drives. Motors with weights follow no faster than this.
inline constexpr DeviceRow kForceFeedback = {
    0, 0, Transport::ForceFeedback, "gamepad", "a strong and a quick motor", makeForceFeedback, 0.010, 0.5};

// Returns a device's row; null if it has no actuator, as keyboards and mice.
const DeviceRow* recognise(const HidInfo& info);

// Returns the four bytes of two tones of one side of Nintendo's controllers, by the tables of dekuNukem's
// Nintendo_Switch_Reverse_Engineering (rumble_data_table.md): the high one 82 to 1253 Hz, the low one 41 to
// 626 Hz, amplitudes up to the last that is safe for the coil. A silent tone gets the neutral frequency, 320
// or 160 Hz.
std::array<uint8_t, 4> encodeSwitchTones(const Actuation& high, const Actuation& low);
int switchAmplitudeIndex(float amplitude); // number of an amplitude in the table, 0 to 100

} // namespace shoal::haptics
