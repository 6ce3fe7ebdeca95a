// Which devices can be felt, as data: each once. Command line, driver, tests and udev rules go by this table.
#pragma once

#include "input/haptics/Driver.h"
#include "input/haptics/HidBus.h"
#include "input/haptics/SimpleHaptic.h"

#include <optional>
#include <span>
#include <string>

namespace shoal::haptics {

enum class Encoding { DualSense, DualShock4, Switch, Xbox, Stadia };

struct DeviceRow {
    uint16_t vendor, product;
    Transport transport; // Any: both alike
    const char* name;
    const char* motors;
    Encoding encoding;
    double leastWrite_s, refresh_s; // as in Driver
};
std::span<const DeviceRow> deviceTable();

// The row of a device, or what its report descriptor says that it is.
struct Recognised {
    enum class Kind { Listed, SimpleHaptic, Glove } kind = Kind::Listed;
    const DeviceRow* row = nullptr; // of a listed one
    ReportLayout layout;            // of the others
    std::string name;
    const char* motors = "";
};

// Empty for all that cannot be felt: keyboards, mice.
std::optional<Recognised>
recognise(const HidInfo& info, const std::function<std::vector<uint8_t>(const std::string&)>& descriptor);

// How to speak to it. readFeature: of the opened device. Empty if it has nothing that can be used.
std::optional<Driver> driverOf(const Recognised& device, Transport transport, const ReadFeature& readFeature);

} // namespace shoal::haptics
