// A tick takes no memory from the heap once its scratch memory has its size.
#include "Fixture.h"
#include "tests/unit/Heap.h"

#include <gtest/gtest.h>

namespace shoal::game {
namespace {

TEST(Allocation, ATickTakesNoMemory) {
    Dive dive(test::cove().species, test::cove().dive, 2);
    Snapshot a, b, shown;
    Events events;
    events.reserve(1000);
    TickInput input;
    dive.snapshot(a);
    dive.snapshot(b);
    interpolate(a, b, 0.5f, shown);
    for (int i = 0; i < 6000; ++i) {
        if (i == 120) heap::counting = true;
        events.clear();
        // Hands that swing and close, so that contacts and grabs happen; one of them gets lost at times.
        const float x = static_cast<float>(i % 240) / 240 - 0.5f;
        input.hands[1] = test::handAt({x, -0.1f, -0.8f}, i % 90 < 45 ? 0.0f : 1.0f);
        input.hands[0] = test::handAt({-x, 0, -0.7f}, i % 70 < 45 ? 0.0f : 1.0f, 0);
        input.hands[0].tracked = i % 400 > 60;
        input.hands[0].solid = i % 400 > 90;
        dive.step(input, events);
        b = a;
        dive.snapshot(a);
        interpolate(b, a, 0.5f, shown);
        (void)dive.stateHash();
    }
    heap::counting = false;
    EXPECT_EQ(heap::allocations, 0);
}

} // namespace
} // namespace shoal::game
