// A replay, read to its end, and the rules and inputs that it gives the simulation.
#include "game/rules/Dive.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input.replay");
    auto reader = sim::RecordingReader::open(file({data, size}));
    if (!reader) return 0;
    (void)game::rulesOf(reader->header());
    while (!reader->atEnd()) {
        const auto tick = reader->next();
        if (!tick) return 0;
        fuzz::expect(tick->input.size() == reader->header().inputBytes);
        if (tick->input.size() == game::kTickInputBytes)
            (void)game::fromBytes(tick->input.first<game::kTickInputBytes>());
    }
    return 0;
}
