// The protocol of one haptic device: how a frame becomes the bytes of a HID output report, and how often it
// is written. Pure functions of the frame; used on the thread of HapticOutput.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/HidBus.h"
#include "input/haptics/ReportDescriptor.h"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace shoal::haptics {

constexpr size_t kMaxReportBytes = 78;

// As hidapi sends them: the report's id first.
struct Report {
    std::array<uint8_t, kMaxReportBytes> bytes{};
    size_t size = 0;

    std::span<const uint8_t> view() const { return std::span(bytes).first(size); }
    bool operator==(const Report&) const = default;
};

struct Driver {
    // Equal reports mean equal vibration: what differs from one write to the next (a sequence number, a
    // checksum) is filled in by seal, if there is any.
    std::function<Report(const HapticFrame&)> encode;
    void (*seal)(Report&, uint8_t sequence) = nullptr;
    std::vector<Report> initialReports;                         // written first, sealed likewise
    double minWrite_s = 0;                                      // between two writes
    double refresh_s = std::numeric_limits<double>::infinity(); // a vibration is repeated after that: devices
                                                                // stop by themselves
    bool oneShot = false; // each report plays one short pulse, so that only a growing amplitude is written

    Report sealed(const HapticFrame& frame, uint8_t sequence) const {
        Report report = encode(frame);
        if (seal) seal(report, sequence);
        return report;
    }
};

// Reads a feature report: the buffer's first byte is the id; how many bytes came, id counted, 0 on failure.
using ReadFeature = std::function<size_t(std::span<uint8_t>)>;

// The opened device that a driver is made for.
struct DeviceContext {
    uint16_t product;
    bool bluetooth;
    const ReportLayout& layout; // empty for devices known by vendor and product
    const ReadFeature& readFeature;
};

} // namespace shoal::haptics
