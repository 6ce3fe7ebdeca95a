// The devices' bus, as a few functions: hidapi's, or a recording one in tests.
#pragma once

#include "engine/core/Result.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace shoal::haptics {

struct HidInfo {
    std::string path; // names it to open()
    uint16_t vendor = 0, product = 0;
};

struct HidBus {
    std::function<std::vector<HidInfo>()> list;               // of all devices; may take some milliseconds
    std::function<Result<int>(const std::string& path)> open; // a handle, 0 or above
    std::function<bool(int handle, std::span<const uint8_t> report)> write; // false: the device is gone
    std::function<void(int handle)> close;
};

// hidapi's. One thread at a time; lives until the last copy goes.
HidBus hidapiBus();

} // namespace shoal::haptics
