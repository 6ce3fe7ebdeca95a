// The controllers that can be felt, as data: one row and one encoder each. Pure; no device is touched here.
#pragma once

#include "input/haptics/HapticFrame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace shoal::haptics {

constexpr size_t kMaxReportBytes = 78;

struct Report { // as hidapi sends it: the report's id first
    std::array<uint8_t, kMaxReportBytes> bytes{};
    size_t size = 0;

    bool operator==(const Report&) const = default;
};

// The two motors of a common controller, 0 to 255: a heavy slow one and a light quick one.
struct Motors {
    uint8_t strong = 0, weak = 0;

    bool operator==(const Motors&) const = default;
};

// Twelve actuators on two motors: each actuation goes to both by its frequency, all to the strong one up to
// 60 Hz and all to the weak one from 200 Hz, and the strongest of them counts, so that many fingers are not
// felt as one blow. Motors start only at about a fifth of their range; amplitudes from 0 are laid over what
// can be felt, and 0 stays 0.
Motors motorsOf(const HapticFrame& frame);

struct Controller {
    uint16_t vendor, product;
    const char* name;
    Report (*encode)(const Motors&);
};

Report encodeDualSenseUsb(const Motors& motors);
Report encodeDualShock4Usb(const Motors& motors);

std::span<const Controller> controllers();
const Controller* findController(uint16_t vendor, uint16_t product); // null if it is none of ours

} // namespace shoal::haptics
