// Driver of the fingertip glove of content/glove/GLOVE.md.
#include "input/haptics/DeviceTable.h"

#include "input/haptics/GloveReport.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

static_assert(glove::kActuators == kActuatorCount);

namespace {

// Bytes: 0 (reports have no id), sequence, twelve amplitudes, twelve frequencies. The body's vibration, for
// which a glove has no actuator, goes to both palms.
Report gloveReport(const HapticFrame& frame) {
    Report report{.size = 1 + glove::kReportBytes};
    for (size_t i = 0; i < kActuatorCount; ++i) {
        Actuation felt = frame.actuators[i];
        if (i % kActuatorsPerHand == hands::kPalmPart && frame.body.amplitude > felt.amplitude)
            felt = frame.body;
        if (!(felt.amplitude > 0)) continue; // NaN too
        report.bytes[2 + i] = static_cast<uint8_t>(std::lround(std::min(felt.amplitude, 1.0f) * 255));
        report.bytes[2 + kActuatorCount + i] = static_cast<uint8_t>(
            std::lround(std::clamp(felt.frequency_Hz / static_cast<float>(glove::kHzPerStep), 1.0f, 255.0f)));
    }
    return report;
}

void sealGlove(Report& report, uint8_t sequence) { report.bytes[1] = sequence; }

} // namespace

Driver makeGlove(const DeviceContext&) { return {.encode = gloveReport, .seal = sealGlove}; }

} // namespace shoal::haptics
