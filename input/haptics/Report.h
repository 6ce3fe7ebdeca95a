// Bytes for a device, as hidapi sends them: the report's id first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace shoal::haptics {

constexpr size_t kMaxReportBytes = 78;

struct Report {
    std::array<uint8_t, kMaxReportBytes> bytes{};
    size_t size = 0;

    std::span<const uint8_t> view() const { return std::span(bytes).first(size); }
    bool operator==(const Report&) const = default;
};

} // namespace shoal::haptics
