// Access to haptic devices as a few functions: hidapi's, or a recording fake in tests.
#pragma once

#include "engine/core/Result.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace shoal::haptics {

// ForceFeedback: not HID, but the kernel's own driver (ForceFeedback.h).
enum class Transport { Any, Usb, Bluetooth, ForceFeedback };

struct HidInfo {
    std::string path; // names it to open()
    uint16_t vendor = 0, product = 0;
    Transport transport = Transport::Any;
    std::string name;   // as the device calls itself; may be empty
    std::string device; // the system's name of the device behind the path, which may have several; or empty
    uint16_t usagePage = 0, usage = 0; // of its first collection of reports
};

struct HidBus {
    // All devices, each path once; may take some milliseconds, unless nothing was plugged in or out.
    std::function<std::vector<HidInfo>()> list;
    std::function<Result<int>(const std::string& path)> open;               // a handle, 0 or above
    std::function<bool(int handle, std::span<const uint8_t> report)> write; // false: the device is gone
    // Fills the buffer, whose first byte is the report's id; how many bytes, id counted, or 0.
    std::function<size_t(int handle, std::span<uint8_t> report)> readFeature;
    // From now until close(): should the program die by a signal, this report is still written.
    std::function<void(int handle, std::span<const uint8_t> stop)> guard;
    std::function<void(int handle)> close;
};

// hidapi's. One thread at a time; lives until the last copy goes.
HidBus hidapiBus();

} // namespace shoal::haptics
