// A HID simple haptic controller (usage page 0E of the HID Usage Tables): it has a list of waveforms, and
// plays one when told its place in the list.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/Report.h"
#include "input/haptics/ReportDescriptor.h"

#include <functional>
#include <optional>
#include <vector>

namespace shoal::haptics {

// Reads a feature report: the buffer's first byte is the id; how many bytes came, id counted, 0 on failure.
using ReadFeature = std::function<size_t(std::span<uint8_t>)>;

struct SimpleHaptic {
    struct Waveform {
        uint16_t ordinal = 0;     // its place in the device's list; 0: it has none such
        uint32_t duration_ms = 0; // 0: not told
        bool goesOn = false;      // until it is stopped; else it is one stroke
    };
    Waveform slow, quick; // for low and high frequencies, the best of the list for each
    ReportField trigger;
    std::optional<ReportField> intensity, repeats, cutoff;
    size_t reportBytes = 0; // the id not counted

    bool strikes() const { return !slow.goesOn; } // it can only be struck, not sounded
    Report encode(const HapticFrame& frame) const;
};

// Whether the device says that it is one; costs no talk with it.
bool hasSimpleHaptic(const ReportLayout& layout);

// Empty if it is none, or names no waveform that can be used.
std::optional<SimpleHaptic> findSimpleHaptic(const ReportLayout& layout, const ReadFeature& readFeature);

} // namespace shoal::haptics
