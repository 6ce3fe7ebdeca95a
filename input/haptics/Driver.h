// How one device is spoken to.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/Report.h"

#include <functional>
#include <vector>

namespace shoal::haptics {

struct Driver {
    // A frame as the device shall read it. Equal reports mean an equal feeling; what differs from one writing
    // to the next (sequence, checksum) is put in by seal, if there is any.
    std::function<Report(const HapticFrame&)> encode;
    void (*seal)(Report&, uint8_t sequence) = nullptr;
    std::vector<Report> greeting; // to be written first, sealed likewise
    double leastWrite_s = 0.01;   // between two writings
    double refresh_s = 0.5;       // what is felt is told again after that, for the device stops by itself
    bool strikes = false;         // each writing is one stroke, so only what grows is written

    Report sealed(const HapticFrame& frame, uint8_t sequence) const {
        Report report = encode(frame);
        if (seal) seal(report, sequence);
        return report;
    }
};

} // namespace shoal::haptics
