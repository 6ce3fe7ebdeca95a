// The table of haptic devices: identification, description, driver and pace of each. Recognition, the list of
// `shoal devices` and the tests of bytes and of udev rules follow from it.
#pragma once

#include "input/haptics/Driver.h"

#include <array>
#include <optional>
#include <string>

namespace shoal::haptics {

// Each in the file named beside it. Empty: the device has no actuator that can be used.
using MakeDriver = std::optional<Driver>(const DeviceContext&);
MakeDriver makeDualSense, makeDualShock4, makeXbox, makeStadia; // Gamepads.cpp
MakeDriver makeSwitch;                                          // Switch.cpp
MakeDriver makeGlove;                                           // Glove.cpp
MakeDriver makeSimpleHaptic;                                    // SimpleHaptic.cpp

struct DeviceRow {
    uint16_t vendor, product;
    Transport transport; // Any: both alike
    const char* name;
    const char* motors;
    MakeDriver* driver;
    double minWrite_s, refresh_s; // as in Driver, which may refresh more often
};

// Pace. USB: the controller polls every 4 ms. Bluetooth: reports that come more often than every 10 ms queue
// up before the radio. Nintendo: as documented; its voice coils fall silent after about 60 ms.
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

// Devices of any vendor, known by their report descriptor. The glove's watchdog waits 0.1 s.
struct DescriptorRow {
    bool (*matches)(const ReportLayout&);
    DeviceRow device;
};
bool isGlove(const ReportLayout& layout);
bool hasSimpleHaptic(const ReportLayout& layout);
inline constexpr auto kDevicesByDescriptor = std::to_array<DescriptorRow>({
    {isGlove,
     {0, 0, Transport::Any, "fingertip glove", "ten fingertips and two palms", makeGlove, 0.002, 0.040}},
    {hasSimpleHaptic, {0, 0, Transport::Any, "haptic device", "one actuator", makeSimpleHaptic, 0.020, 0.5}},
});

struct Recognised {
    const DeviceRow* row;
    ReportLayout layout;
    std::string name;
};

// Empty for all that has no actuator: keyboards, mice. descriptor: reads the report descriptor of a path.
std::optional<Recognised>
recognise(const HidInfo& info, const std::function<std::vector<uint8_t>(const std::string&)>& descriptor);

// The two tones of one side of Nintendo's controllers in four bytes, by the tables of dekuNukem's
// Nintendo_Switch_Reverse_Engineering (rumble_data_table.md): the high one 82 to 1253 Hz, the low one 41 to
// 626 Hz, amplitudes up to the last that is safe for the coil. Frequencies out of range go to its end; of a
// silent tone the frequency is the neutral one, 320 and 160 Hz.
std::array<uint8_t, 4> encodeSwitchTones(const Actuation& high, const Actuation& low);
int switchAmplitudeIndex(float amplitude); // number of an amplitude in the table, 0 to 100

// HID simple haptic controllers (usage page 0E of the HID Usage Tables): the device has a list of waveforms
// and plays the one whose index it receives.
struct SimpleHaptic {
    struct Waveform {
        uint16_t ordinal = 0;     // its place in the device's list; 0: it has none such
        uint32_t duration_ms = 0; // 0: unknown
        bool goesOn = false;      // until it is stopped; else it is one short pulse
    };
    Waveform slow, quick; // for low and high frequencies, the best of the list for each
    ReportField trigger;
    std::optional<ReportField> intensity, repeats, cutoff;
    size_t reportBytes = 0; // the id not counted

    bool oneShot() const { return !slow.goesOn; } // it only plays short pulses
    Report encode(const HapticFrame& frame) const;
};

// Empty if it is none, or names no waveform that can be used.
std::optional<SimpleHaptic> findSimpleHaptic(const ReportLayout& layout, const ReadFeature& readFeature);

// readFeature: of the opened device. Empty if it has nothing that can be used.
std::optional<Driver> driverOf(const Recognised& device, Transport transport, const ReadFeature& readFeature);

} // namespace shoal::haptics
