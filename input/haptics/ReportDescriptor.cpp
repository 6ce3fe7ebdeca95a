#include "input/haptics/ReportDescriptor.h"

#include <algorithm>

namespace shoal::haptics {

namespace {

constexpr size_t kMaxBytes = 4096, kMaxFields = 1024, kMaxDepth = 32;
constexpr uint32_t kMaxBits = 8 * 4096; // of a report

struct Globals {
    uint16_t page = 0;
    int32_t logicalMin = 0, logicalMax = 0;
    uint32_t size_bits = 0, count = 0;
    uint8_t report = 0;
};

struct Locals {
    std::vector<uint32_t> usages;
    uint32_t first = 0;
};

// A short item's data, as a number without and with sign.
uint32_t plain(std::span<const uint8_t> data) {
    uint32_t value = 0;
    for (size_t i = 0; i < data.size(); ++i) value |= uint32_t{data[i]} << (8 * i);
    return value;
}
int32_t withSign(std::span<const uint8_t> data) {
    const uint32_t value = plain(data);
    if (data.size() == 1) return static_cast<int8_t>(value);
    if (data.size() == 2) return static_cast<int16_t>(value);
    return static_cast<int32_t>(value);
}

struct Reader {
    ReportLayout layout;
    Globals globals;
    Locals locals;
    std::vector<Globals> pushed;
    std::vector<uint32_t> collections;

    uint32_t usageOf(std::span<const uint8_t> data) const {
        return data.size() == 4 ? plain(data) : usage(globals.page, static_cast<uint16_t>(plain(data)));
    }

    // False: no use reading on.
    bool addFields(ReportKind kind, uint32_t flags) {
        uint32_t& at = layout.lengths_bits[static_cast<size_t>(kind) * 256 + globals.report];
        constexpr uint32_t kConstant = 1, kVariable = 2;
        if (globals.size_bits > kMaxBits || globals.count > kMaxBits ||
            uint64_t{globals.size_bits} * globals.count > kMaxBits - at)
            return false;
        const bool named = !(flags & kConstant) && (flags & kVariable) && !locals.usages.empty() &&
                           globals.size_bits >= 1 && globals.size_bits <= 32;
        if (named && globals.count > kMaxFields - layout.fields.size()) return false;
        for (uint32_t i = 0; i < globals.count && named; ++i) {
            // The last usage is that of all further fields.
            layout.fields.push_back({kind, globals.report,
                                     locals.usages[std::min<size_t>(i, locals.usages.size() - 1)],
                                     at + i * globals.size_bits, globals.size_bits, globals.logicalMin,
                                     globals.logicalMax, collections});
        }
        at += globals.size_bits * globals.count;
        return true;
    }

    // One short item, by its prefix without the size; false: no use reading on. Long because it is the
    // specification's table of items, a case each.
    bool item(uint8_t prefix, std::span<const uint8_t> data) {
        const uint32_t value = plain(data);
        bool sound = true;
        switch (prefix) {
        case 0x80:
            sound = addFields(ReportKind::Input, value);
            break;
        case 0x90:
            sound = addFields(ReportKind::Output, value);
            break;
        case 0xB0:
            sound = addFields(ReportKind::Feature, value);
            break;
        case 0xA0: // collection
            collections.push_back(locals.usages.empty() ? 0 : locals.usages.front());
            sound = collections.size() <= kMaxDepth;
            break;
        case 0xC0: // its end
            sound = !collections.empty();
            if (sound) collections.pop_back();
            break;
        case 0x04:
            globals.page = static_cast<uint16_t>(value);
            break;
        case 0x14:
            globals.logicalMin = withSign(data);
            break;
        case 0x24:
            // Many a device writes 255 as one byte where its minimum is 0; the sign is not meant then.
            globals.logicalMax = globals.logicalMin >= 0 ? static_cast<int32_t>(value) : withSign(data);
            break;
        case 0x74:
            globals.size_bits = value;
            break;
        case 0x84:
            globals.report = static_cast<uint8_t>(value);
            break;
        case 0x94:
            globals.count = value;
            break;
        case 0xA4:
            pushed.push_back(globals);
            return pushed.size() <= kMaxDepth;
        case 0xB4:
            if (pushed.empty()) return false;
            globals = pushed.back();
            pushed.pop_back();
            break;
        case 0x08:
            locals.usages.push_back(usageOf(data));
            break;
        case 0x18:
            locals.first = usageOf(data);
            break;
        case 0x28: {
            const uint32_t last = usageOf(data);
            if (last < locals.first || last - locals.first >= kMaxFields) return false;
            for (uint32_t i = 0; i <= last - locals.first; ++i) locals.usages.push_back(locals.first + i);
            break;
        }
        default: // units and physical extents
            break;
        }
        const int type = prefix >> 2; // in its lower two bits: main, global, local, reserved
        if ((type & 3) == 0) locals = {};
        return sound && (type & 3) != 3 && locals.usages.size() <= kMaxFields;
    }
};

} // namespace

bool ReportField::isWithin(uint32_t collection) const {
    return std::find(within.begin(), within.end(), collection) != within.end();
}

size_t ReportLayout::bytes(ReportKind kind, uint8_t report) const {
    return (lengths_bits[static_cast<size_t>(kind) * 256 + report] + 7) / 8;
}

ReportLayout readReportDescriptor(std::span<const uint8_t> descriptor) {
    Reader reader;
    descriptor = descriptor.first(std::min(descriptor.size(), kMaxBytes));
    while (!descriptor.empty()) {
        const uint8_t prefix = descriptor[0];
        constexpr uint8_t kLong = 0xFE;
        if (prefix == kLong) { // reserved; its second byte tells how much to pass over
            if (descriptor.size() < 3 || descriptor.size() < size_t{3} + descriptor[1]) break;
            descriptor = descriptor.subspan(size_t{3} + descriptor[1]);
            continue;
        }
        const size_t size = (prefix & 3) == 3 ? 4 : prefix & 3;
        if (descriptor.size() < 1 + size) break;
        if (!reader.item(prefix & 0xFC, descriptor.subspan(1, size))) break;
        descriptor = descriptor.subspan(1 + size);
    }
    return std::move(reader.layout);
}

uint32_t getField(const ReportField& field, std::span<const uint8_t> report) {
    uint32_t value = 0;
    for (uint32_t i = 0; i < field.bits; ++i) {
        const uint32_t bit = field.firstBit + i;
        if (bit / 8 < report.size() && (report[bit / 8] >> (bit % 8) & 1)) value |= uint32_t{1} << i;
    }
    return value;
}

void setField(const ReportField& field, uint32_t value, std::span<uint8_t> report) {
    for (uint32_t i = 0; i < field.bits; ++i) {
        const uint32_t bit = field.firstBit + i;
        if (bit / 8 >= report.size()) return;
        const auto mask = static_cast<uint8_t>(1u << (bit % 8));
        report[bit / 8] = static_cast<uint8_t>((report[bit / 8] & ~mask) | (value >> i & 1 ? mask : 0));
    }
}

} // namespace shoal::haptics
