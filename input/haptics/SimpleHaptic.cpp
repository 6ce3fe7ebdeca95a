#include "input/haptics/DeviceTable.h"
#include "input/haptics/HapticFrame.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

namespace {

constexpr uint16_t kPage = 0x0E, kOrdinals = 0x0A;
constexpr uint32_t kController = usage(kPage, 0x01), kWaveformList = usage(kPage, 0x10),
                   kDurationList = usage(kPage, 0x11), kManualTrigger = usage(kPage, 0x21),
                   kIntensity = usage(kPage, 0x23), kRepeats = usage(kPage, 0x24),
                   kCutoff = usage(kPage, 0x28);
enum Shape : uint16_t { Click = 0x1003, Buzz = 0x1004, Rumble = 0x1005, Press = 0x1006, Release = 0x1007 };
constexpr uint16_t kStop = 2;        // ordinals 1 and 2 are the same everywhere: nothing, and stop
constexpr float kQuickFrom_Hz = 100; // the deepest that still feels like a buzz

// Best first; continuous waveforms come before short pulses.
constexpr std::array<uint16_t, 5> kForSlow = {Rumble, Buzz, Click, Press, Release};
constexpr std::array<uint16_t, 5> kForQuick = {Buzz, Rumble, Click, Press, Release};

const ReportField* findOutput(const ReportLayout& layout, uint32_t wanted,
                              std::optional<uint8_t> report = {}) {
    for (const ReportField& field : layout.fields)
        if (field.kind == ReportKind::Output && field.usage == wanted && field.isWithin(kController) &&
            (!report || field.report == *report))
            return &field;
    return nullptr;
}

struct Listed {
    uint16_t ordinal = 0, shape = 0;
    uint32_t duration_ms = 0;
};

std::vector<Listed> readList(const ReportLayout& layout, const ReadFeature& readFeature) {
    std::vector<Listed> list;
    std::vector<uint8_t> bytes;
    int read = -1; // the report that lies in bytes
    for (const uint32_t collection : {kWaveformList, kDurationList}) {
        for (const ReportField& field : layout.fields) {
            if (field.kind != ReportKind::Feature || !field.isWithin(collection) ||
                field.usage >> 16 != kOrdinals)
                continue;
            if (read != field.report) {
                bytes.assign(1 + layout.bytes(ReportKind::Feature, field.report), 0);
                bytes[0] = field.report;
                bytes.resize(std::min(readFeature(bytes), bytes.size()));
                read = field.report;
            }
            if (bytes.size() < 2) continue;
            const uint32_t value = getField(field, std::span(bytes).subspan(1));
            const auto ordinal = static_cast<uint16_t>(field.usage);
            const auto known = std::find_if(list.begin(), list.end(),
                                            [&](const Listed& each) { return each.ordinal == ordinal; });
            // Where it is told at all, the upper half of a waveform is its usage page.
            if (collection == kWaveformList && (value >> 16 == 0 || value >> 16 == kPage))
                list.push_back({ordinal, static_cast<uint16_t>(value)});
            else if (collection == kDurationList && known != list.end())
                known->duration_ms = value;
        }
    }
    return list;
}

SimpleHaptic::Waveform choose(const std::vector<Listed>& list, std::span<const uint16_t> shapes) {
    for (const uint16_t shape : shapes)
        for (const Listed& each : list)
            if (each.shape == shape)
                return {each.ordinal, each.duration_ms, shape == Buzz || shape == Rumble};
    return {};
}

uint32_t maximum(const ReportField& field) { return static_cast<uint32_t>(std::max(field.logicalMax, 0)); }

} // namespace

bool hasSimpleHaptic(const ReportLayout& layout) { return findOutput(layout, kManualTrigger); }

std::optional<SimpleHaptic> findSimpleHaptic(const ReportLayout& layout, const ReadFeature& readFeature) {
    const ReportField* trigger = findOutput(layout, kManualTrigger);
    if (!trigger) return {};
    const auto list = readList(layout, readFeature);
    SimpleHaptic found{.slow = choose(list, kForSlow), .quick = choose(list, kForQuick), .trigger = *trigger};
    found.reportBytes = layout.bytes(ReportKind::Output, trigger->report);
    if (found.slow.ordinal == 0 || 1 + found.reportBytes > kMaxReportBytes) return {};
    const auto beside = [&](uint32_t wanted) -> std::optional<ReportField> {
        const ReportField* field = findOutput(layout, wanted, trigger->report);
        return field ? std::optional(*field) : std::nullopt;
    };
    found.intensity = beside(kIntensity);
    found.repeats = beside(kRepeats);
    found.cutoff = beside(kCutoff);
    return found;
}

std::optional<Driver> makeSimpleHaptic(const DeviceContext& device) {
    const auto found = findSimpleHaptic(device.layout, device.readFeature);
    if (!found) return {};
    Driver driver{.encode = [=](const HapticFrame& frame) { return found->encode(frame); },
                  .oneShot = found->oneShot()};
    // A waveform that lasts a given time is repeated after half of it.
    for (const SimpleHaptic::Waveform& waveform : {found->slow, found->quick})
        if (waveform.goesOn && waveform.duration_ms > 0)
            driver.refresh_s = std::min(driver.refresh_s, waveform.duration_ms / 2 * 1e-3);
    return driver;
}

Report SimpleHaptic::encode(const HapticFrame& frame) const {
    const Actuation strongest = strongestOf(frame);
    const float amplitude = std::min(strongest.amplitude, 1.0f);
    const Waveform& waveform = strongest.frequency_Hz >= kQuickFrom_Hz ? quick : slow;

    Report report{.size = 1 + reportBytes};
    report.bytes[0] = trigger.report;
    const auto body = std::span(report.bytes).subspan(1, reportBytes);
    const bool silent = !(amplitude > 1.0f / 512);
    setField(trigger, silent ? kStop : waveform.ordinal, body);
    if (silent) return report;
    if (intensity) {
        const auto minimum = static_cast<float>(std::max(intensity->logicalMin, 0));
        const float span = static_cast<float>(maximum(*intensity)) - minimum;
        setField(*intensity, static_cast<uint32_t>(std::lround(minimum + amplitude * std::max(span, 0.0f))),
                 body);
    }
    if (repeats) setField(*repeats, 0, body);
    if (cutoff) setField(*cutoff, maximum(*cutoff), body); // as long as it takes
    return report;
}

} // namespace shoal::haptics
