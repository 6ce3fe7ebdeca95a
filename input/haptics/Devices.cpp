#include "input/haptics/Devices.h"

#include "input/haptics/Gamepads.h"
#include "input/haptics/Glove.h"
#include "input/haptics/Switch.h"

#include <algorithm>
#include <array>

namespace shoal::haptics {

namespace {

constexpr auto Usb = Transport::Usb, Bluetooth = Transport::Bluetooth, Any = Transport::Any;

constexpr const char *kTwo = "a strong and a quick motor", *kCoils = "a voice coil in each hand",
                     *kOneCoil = "a voice coil",
                     *kFour = "a strong and a quick motor, one behind each trigger";

// The last two columns. USB: the controller asks every 4 ms. Bluetooth: more often than every 10 ms and the
// reports queue up before the radio. Nintendo: as documented; its coils fall silent after about 60 ms.
constexpr std::array<DeviceRow, 20> kDevices = {{
    {0x054c, 0x0ce6, Usb, "DualSense", kTwo, Encoding::DualSense, 0.004, 0.5},
    {0x054c, 0x0ce6, Bluetooth, "DualSense", kTwo, Encoding::DualSense, 0.010, 0.5},
    {0x054c, 0x0df2, Usb, "DualSense Edge", kTwo, Encoding::DualSense, 0.004, 0.5},
    {0x054c, 0x0df2, Bluetooth, "DualSense Edge", kTwo, Encoding::DualSense, 0.010, 0.5},
    {0x054c, 0x05c4, Usb, "DualShock 4", kTwo, Encoding::DualShock4, 0.004, 0.5},
    {0x054c, 0x05c4, Bluetooth, "DualShock 4", kTwo, Encoding::DualShock4, 0.010, 0.5},
    {0x054c, 0x09cc, Usb, "DualShock 4", kTwo, Encoding::DualShock4, 0.004, 0.5},
    {0x054c, 0x09cc, Bluetooth, "DualShock 4", kTwo, Encoding::DualShock4, 0.010, 0.5},
    {0x054c, 0x0ba0, Usb, "DualShock 4 wireless adaptor", kTwo, Encoding::DualShock4, 0.004, 0.5},
    {0x057e, 0x2009, Any, "Switch Pro Controller", kCoils, Encoding::Switch, 0.030, 0.050},
    {0x057e, 0x2006, Any, "Joy-Con L", kOneCoil, Encoding::Switch, 0.030, 0.050},
    {0x057e, 0x2007, Any, "Joy-Con R", kOneCoil, Encoding::Switch, 0.030, 0.050},
    {0x057e, 0x200e, Any, "Joy-Con grip", kCoils, Encoding::Switch, 0.030, 0.050},
    {0x045e, 0x02e0, Bluetooth, "Xbox One S controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x045e, 0x02fd, Bluetooth, "Xbox One S controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x045e, 0x0b20, Bluetooth, "Xbox One S controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x045e, 0x0b13, Bluetooth, "Xbox Series controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x045e, 0x0b05, Bluetooth, "Xbox Elite 2 controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x045e, 0x0b22, Bluetooth, "Xbox Elite 2 controller", kFour, Encoding::Xbox, 0.010, 0.5},
    {0x18d1, 0x9400, Any, "Stadia controller", kTwo, Encoding::Stadia, 0.010, 0.5},
}};

constexpr double kGloveWrite_s = 0.002, kGloveRefresh_s = 0.040; // its watchdog waits 0.1 s
constexpr double kSimpleWrite_s = 0.020, kSimpleRefresh_s = 0.5;

// Feature report 20 tells the firmware's version; from 2.21 on, and on every Edge, vibration is enabled anew.
bool hasNewVibration(const DeviceRow& row, const ReadFeature& readFeature) {
    constexpr uint16_t kEdge = 0x0df2, kFrom = 2 << 8 | 21;
    constexpr size_t kVersionAt = 44;
    if (row.product == kEdge) return true;
    std::array<uint8_t, 64> bytes{0x20};
    return readFeature(bytes) == bytes.size() && (bytes[kVersionAt] | bytes[kVersionAt + 1] << 8) >= kFrom;
}

Driver listedDriver(const DeviceRow& row, bool bluetooth, const ReadFeature& readFeature) {
    Driver driver{.leastWrite_s = row.leastWrite_s, .refresh_s = row.refresh_s};
    switch (row.encoding) {
    case Encoding::DualSense: {
        const bool anew = hasNewVibration(row, readFeature);
        driver.encode = bluetooth ? (anew ? encodeDualSenseBluetoothNew : encodeDualSenseBluetooth)
                                  : (anew ? encodeDualSenseUsbNew : encodeDualSenseUsb);
        if (bluetooth) driver.seal = sealDualSenseBluetooth;
        break;
    }
    case Encoding::DualShock4:
        driver.encode = bluetooth ? encodeDualShock4Bluetooth : encodeDualShock4Usb;
        if (bluetooth) driver.seal = sealDualShock4Bluetooth;
        break;
    case Encoding::Switch:
        driver.encode = bluetooth ? encodeSwitchBluetooth : encodeSwitchUsb;
        driver.seal = sealSwitch;
        driver.greeting = {bluetooth ? switchEnableBluetooth() : switchEnableUsb()};
        break;
    case Encoding::Xbox:
        driver.encode = encodeXboxBluetooth;
        break;
    case Encoding::Stadia:
        driver.encode = encodeStadia;
        break;
    }
    return driver;
}

Driver simpleDriver(const SimpleHaptic& device) {
    Driver driver{.leastWrite_s = kSimpleWrite_s, .refresh_s = kSimpleRefresh_s, .strikes = device.strikes()};
    driver.encode = [device](const HapticFrame& frame) { return device.encode(frame); };
    // What sounds for a given time is told again after half of it.
    for (const SimpleHaptic::Waveform& waveform : {device.slow, device.quick})
        if (waveform.goesOn && waveform.duration_ms > 0)
            driver.refresh_s = std::clamp(waveform.duration_ms / 2 * 1e-3, kSimpleWrite_s, driver.refresh_s);
    return driver;
}

} // namespace

std::span<const DeviceRow> deviceTable() { return kDevices; }

std::optional<Recognised>
recognise(const HidInfo& info, const std::function<std::vector<uint8_t>(const std::string&)>& descriptor) {
    for (const DeviceRow& row : kDevices)
        if (row.vendor == info.vendor && row.product == info.product &&
            (row.transport == Any || row.transport == info.transport))
            return Recognised{.row = &row, .name = row.name, .motors = row.motors};
    ReportLayout layout = readReportDescriptor(descriptor(info.path));
    if (isGlove(layout))
        return Recognised{.kind = Recognised::Kind::Glove,
                          .name = "fingertip glove",
                          .motors = "ten fingertips and two palms"};
    if (hasSimpleHaptic(layout))
        return Recognised{.kind = Recognised::Kind::SimpleHaptic,
                          .layout = std::move(layout),
                          .name = info.name.empty() ? "haptic device" : info.name,
                          .motors = "one actuator"};
    return {};
}

std::optional<Driver> driverOf(const Recognised& device, Transport transport,
                               const ReadFeature& readFeature) {
    switch (device.kind) {
    case Recognised::Kind::Listed:
        return listedDriver(*device.row, transport == Bluetooth, readFeature);
    case Recognised::Kind::Glove:
        return Driver{.encode = encodeGlove,
                      .seal = sealGlove,
                      .leastWrite_s = kGloveWrite_s,
                      .refresh_s = kGloveRefresh_s};
    case Recognised::Kind::SimpleHaptic:
        if (const auto found = findSimpleHaptic(device.layout, readFeature)) return simpleDriver(*found);
        break;
    }
    return {};
}

} // namespace shoal::haptics
