// The shark in the rooms that the films leave: a few of the dives of tests/bench/player/Shark.cpp.
#include "Fixture.h"

#include "tests/bench/player/SharkWatch.h"
#include "tests/playthrough/Rooms.h"

#include <gtest/gtest.h>

namespace shoal::player {
namespace {

TEST(SharkRoom, ItStealsKeepsItsDistanceAndSwimsFartherOutThanFish) {
    auto script = game::loadScript(dataRoot() / "tests/playthrough/shark_steals.toml");
    ASSERT_TRUE(script) << script.error().message();
    game::DiveFiles files = game::test::cove();
    const auto watched = [&] {
        SharkWatch watch;
        for (uint64_t seed = 21; seed < 29; ++seed) {
            script->seed = seed;
            watch.begin();
            game::playScript(*script, tests::rig(), files, {},
                             [&](const game::DiveState& s, const game::Events& events) {
                                 watch.see(s, events, files.dive, files.species);
                             });
        }
        return watch;
    };
    EXPECT_GE(watched().steals, 7) << "of 8 in open water";
    for (const char* film : {"reef", "night", "kelp"}) {
        ASSERT_TRUE(game::roomOf(film).moveTo(files.dive.space)) << film;
        const SharkWatch w = watched();
        // It stole in 72 to 94 % of 32 dives; one set of eight dives in fifty has fewer than four thefts.
        EXPECT_GE(w.steals, 4) << film;
        EXPECT_GE(w.fartherWithRoom, 0.85 * w.roomTicks) << film;
        EXPECT_LE(w.middleNear, 0.05 * w.ticks) << film; // the reef's tunnel leaves no other place at times
    }
}

} // namespace
} // namespace shoal::player
