// A HID report descriptor (its length in the first two bytes), and reports read and written by it.
#include "input/haptics/ReportDescriptor.h"
#include "tests/fuzz/Target.h"

#include <algorithm>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 2) return 0;
    const size_t length = std::min<size_t>(data[0] | data[1] << 8, size - 2);
    const std::span<const uint8_t> descriptor(data + 2, length), report(data + 2 + length, size - 2 - length);
    const haptics::ReportLayout layout = haptics::readReportDescriptor(descriptor);
    fuzz::expect(layout.fields.size() <= 1024);
    for (const haptics::ReportField& field : layout.fields) {
        fuzz::expect(field.bits >= 1 && field.bits <= 32);
        (void)haptics::getField(field, report);
        const size_t bytes = layout.bytes(field.kind, field.report);
        fuzz::expect(8 * bytes >= size_t{field.firstBit} + field.bits);
        std::vector<uint8_t> written(std::min<size_t>(bytes, 4096));
        const uint32_t most = field.bits == 32 ? ~0u : (1u << field.bits) - 1;
        haptics::setField(field, most, written);
        if (written.size() == bytes) fuzz::expect(haptics::getField(field, written) == most);
    }
    return 0;
}
