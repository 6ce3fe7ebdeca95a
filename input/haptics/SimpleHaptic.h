// Driver of HID simple haptic controllers (usage page 0E of the HID Usage Tables): the device has a list of
// waveforms and plays the one whose index it receives.
#pragma once

#include "input/haptics/Driver.h"

namespace shoal::haptics {

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

} // namespace shoal::haptics
