// A few of the dives of tests/bench/players: people at a mouse or with tracked hands catch what a game should
// let them catch. Goals are for 9 of 10 dives; six seeds may miss once.
#include "Fixture.h"

#include "tests/bench/player/PlayedDive.h"
#include "tests/playthrough/Rooms.h"

#include <gtest/gtest.h>

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
    auto files = game::loadDiveFiles("reef");
    ASSERT_TRUE(files) << files.error().message();
    ASSERT_TRUE(game::roomOf(files->dive.video).moveTo(files->dive.space)); // as it is played
    const Case& kind = GetParam();
    int met = 0, inTime = 0;
    for (uint64_t seed : {201, 202, 203, 204, 205, 206}) {
        PlayerSetup setup = kind.setup;
        setup.seed = seed;
        const PlayedDive dive = play(*files, tests::rig(), setup);
        met += dive.caught >= kind.atLeast && dive.caught <= kind.atMost;
        inTime += dive.firstCatch_s <= kind.firstBefore_s;
    }
    // The goal is nine of ten; practised hands reach it in 92 and 93 % of 60 dives from seeds 201 and 5001.
    // With such chances two of six dives fail in one run of ten, and three in one run of a hundred.
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
    [](const auto& parameter) { return std::string(parameter.param.name); });

} // namespace
} // namespace shoal::player
