// Parser of HID report descriptors: which bits of which report mean what (Device Class Definition for
// HID 1.11, chapter 6.2.2). Hand-written because hidapi and hidraw give only the descriptor's bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::haptics {

// A usage as it is named in the usage tables: page in the upper half, number in the lower.
constexpr uint32_t usage(uint16_t page, uint16_t id) { return uint32_t{page} << 16 | id; }

enum class ReportKind { Input, Output, Feature };

struct ReportField {
    ReportKind kind = ReportKind::Input;
    uint8_t report = 0;    // its id; 0 where reports have none
    uint32_t usage = 0;    // what it means
    uint32_t firstBit = 0; // behind the id
    uint32_t bits = 0;     // 1 to 32
    int32_t logicalMin = 0, logicalMax = 0;
    std::vector<uint32_t> within; // usages of the collections around it, outermost first

    bool isWithin(uint32_t collection) const;
};

struct ReportLayout {
    std::vector<ReportField> fields; // constants (padding) and array fields left out

    // Bytes of a report, its id not counted.
    size_t bytes(ReportKind kind, uint8_t report) const;

    std::vector<uint32_t> lengths_bits = std::vector<uint32_t>(3 * 256); // [kind * 256 + report]
};

// From any bytes at all; what is damaged or beyond all measure ends the reading, and the fields before it are
// kept. At most 4096 bytes, 1024 fields.
ReportLayout readReportDescriptor(std::span<const uint8_t> descriptor);

// A field's value in a report, its id not counted; 0 beyond the end. Not sign-extended.
uint32_t getField(const ReportField& field, std::span<const uint8_t> report);
void setField(const ReportField& field, uint32_t value, std::span<uint8_t> report);

} // namespace shoal::haptics
