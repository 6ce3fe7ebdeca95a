// Dives of people and of the shark in the rooms that the films leave, a few of those of tests/bench/player.
#include "Fixture.h"
#include "tests/bench/player/PlayedDive.h"
#include "tests/bench/player/SharkWatch.h"
#include "tests/playthrough/Rooms.h"

namespace shoal::player {
namespace {

struct Case {
    const char* name;
    PlayerSetup setup;
    int atLeast, atMost;
    float firstBefore_s;
};

class Players : public testing::TestWithParam<Case> {};

TEST_P(Players, CatchAsManyAsTheyShould) {
    auto files = tests::valueOf(game::loadDiveFiles("reef"));
    ASSERT_TRUE(game::roomOf(files.dive.video).moveTo(files.dive.space)); // as it is played
    const Case& kind = GetParam();
    int met = 0, inTime = 0;
    for (uint64_t seed : {201, 202, 203, 204, 205, 206}) {
        PlayerSetup setup = kind.setup;
        setup.seed = seed;
        const PlayedDive dive = play(files, tests::rig(), setup);
        met += dive.caught >= kind.atLeast && dive.caught <= kind.atMost;
        inTime += dive.firstCatch_s <= kind.firstBefore_s;
    }
    // The goal is nine of ten; practised hands reach it in 92 and 93 % of 60 dives from seeds 201 and 5001.
    // With such chances two or more of six dives fail in one run of ten, three or more in one of a hundred.
    EXPECT_GE(met, 4);
    EXPECT_GE(inTime, 5);
}

const game::DiveRules kNormal, kNone{game::Assist::None};

INSTANTIATE_TEST_SUITE_P(
    , Players,
    testing::Values(
        Case{"NoviceAtTheMouse", {Skill::Novice, Device::Mouse, kNormal}, 4, 100, 45},
        Case{"PractisedAtTheMouse", {Skill::Practised, Device::Mouse, kNormal}, 10, 18, 90},
        Case{"PractisedAtTheMouseUnassisted", {Skill::Practised, Device::Mouse, kNone}, 4, 100, 90},
        Case{"NoviceWithHands", {Skill::Novice, Device::Hands, kNormal}, 4, 100, 45},
        Case{"PractisedWithHands", {Skill::Practised, Device::Hands, kNormal}, 10, 18, 90},
        Case{"PractisedWithHandsUnassisted", {Skill::Practised, Device::Hands, kNone}, 4, 100, 90}),
    tests::byName);

TEST(SharkRoom, ItStealsKeepsItsDistanceAndSwimsFartherOutThanFish) {
    auto script = tests::valueOf(game::loadScript(dataRoot() / "tests/playthrough/shark_steals.toml"));
    game::DiveFiles files = game::cove();
    const auto watched = [&] {
        SharkWatch watch;
        for (uint64_t seed = 21; seed < 29; ++seed) {
            script.seed = seed;
            watch.begin();
            game::playScript(script, tests::rig(), files, {},
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
        // An offered fish counts after a second, before which the shark gets to it in 2 to 5 of 8 dives.
        EXPECT_GE(w.steals, 2) << film;
        EXPECT_GE(w.fartherWithRoom, 0.85 * w.roomTicks) << film;
        EXPECT_LE(w.middleNear, 0.05 * w.ticks) << film; // the reef's tunnel leaves no other place at times
    }
}

} // namespace
} // namespace shoal::player
