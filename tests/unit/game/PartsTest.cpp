// Parts of the simulation one by one, each given its inputs by hand.
#include "Fixture.h"
#include "engine/core/WriteFile.h"

#include "game/rules/DiveState.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::cove;
using test::handAt;

TEST(Swimmer, BlendsFromOneGaitToTheNextAndKeepsTheOneItHas) {
    Gait gait;
    gait.set(Motion::Dart);
    EXPECT_EQ(gait.before, Motion::Swim);
    EXPECT_EQ(gait.blend, 0);
    for (int i = 0; i < 12; ++i) gait.advance(1);
    EXPECT_NEAR(gait.blend, 0.5f, 1e-4f); // of 0.2 s
    gait.set(Motion::Dart);
    EXPECT_NEAR(gait.blend, 0.5f, 1e-4f);
}

TEST(Swimmer, CirclesAtRightAnglesToTheWayOutward) {
    Swimmer swimmer;
    startCircling(swimmer, {2, 0.3f, 0}, {1, 0, 0}, 1, 0.5f);
    EXPECT_EQ(swimmer.velocity, 0.5f * swimmer.forward);
    EXPECT_NEAR(glm::dot(swimmer.forward, glm::vec3(1, 0, 0)), 0, 1e-6f);
    const glm::vec3 looks = swimmer.worldFromBody * glm::vec3(0, 0, 1);
    EXPECT_NEAR(glm::distance(looks, swimmer.forward), 0, 1e-6f);
    swimmer.spin = {0, 2, 0}; // to the left
    for (int i = 0; i < 240; ++i) bankIntoTurn(swimmer, 0.35f, 0.7f, 5);
    EXPECT_NEAR(swimmer.bank, 0.7f, 1e-3f);
}

// Two fish side by side, both heading along +Z.
std::vector<Fish> pair(float apart_m, int leaderOfSecond) {
    std::vector<Fish> fish(2);
    for (Fish& f : fish) f.route.leader = 0;
    fish[1].route.leader = leaderOfSecond;
    fish[1].position = {apart_m, 0, 0};
    return fish;
}

TEST(Schooling, StrangersGiveWayEvenlyAndCompanionsAlign) {
    const SpeciesTable species(1);
    std::vector<Neighbours> around(2);
    gatherNeighbours(pair(0.15f, 1), species, around);
    EXPECT_LT(around[0].giveWay.x, 0);
    EXPECT_EQ(around[0].giveWay, -around[1].giveWay);
    EXPECT_EQ(around[0].aligned, 0);
    gatherNeighbours(pair(0.3f, 0), species, around);
    EXPECT_EQ(around[0].aligned, 1);
    EXPECT_EQ(around[0].attracted, 0);
    gatherNeighbours(pair(2, 0), species, around);
    EXPECT_EQ(around[0].aligned, 0);
    EXPECT_EQ(around[0].towards, glm::vec3(2, 0, 0));
    gatherNeighbours(pair(2, 1), species, around);
    EXPECT_EQ(around[0].attracted, 0) << "strangers do not attract";
    std::vector<Fish> fish = pair(0.15f, 0);
    fish[1].state = Fish::State::Held;
    gatherNeighbours(fish, species, around);
    EXPECT_EQ(around[0].giveWay, glm::vec3(0)) << "a fish in a hand is no company";
    EXPECT_EQ(around[0].aligned, 0);
}

TEST(HandTracking, ALostHandStaysForATenthOfASecondAndAJumpGivesNoSpeed) {
    TickInput input;
    Viewpoint view;
    Hands hands;
    input.hands[1] = handAt(test::kPlace);
    trackHands(input, view, hands);
    EXPECT_TRUE(hands[1].visible && hands[1].solid);
    EXPECT_FALSE(hands[0].visible);
    EXPECT_EQ(hands[1].velocity, glm::vec3(0)) << "it has only just appeared";
    for (hands::Joint& joint : input.hands[1].joints) joint.position.x += 0.01f;
    trackHands(input, view, hands);
    EXPECT_NEAR(hands[1].velocity.x, 1.2f, 1e-3f);
    EXPECT_NEAR(hands[1].calmVelocity.x, 0.2f, 1e-3f);
    input.hands[1].tracked = false;
    for (int i = 0; i < 12; ++i) {
        trackHands(input, view, hands);
        EXPECT_TRUE(hands[1].visible) << i;
    }
    trackHands(input, view, hands);
    EXPECT_FALSE(hands[1].visible);
    EXPECT_EQ(hands[1].velocity, glm::vec3(0));
}

TEST(FingerWrap, FingersPressOnWhatLiesInTheFistFromBothSides) {
    TickInput input;
    Viewpoint view;
    Hands hands;
    input.hands[1] = handAt(test::kPlace, 1);
    trackHands(input, view, hands);
    const physics::Capsule fish{test::kPlace - glm::vec3(0.03f, 0, 0), test::kPlace + glm::vec3(0.03f, 0, 0),
                                0.024f};
    wrapFingers(fish, hands[1]);
    EXPECT_GT(hands[1].fingers.pressCount, 2);
    hands[1].grasp.encloses = 4;
    EXPECT_GT(holdOn(4, hands, {}, glm::vec3(0)).margin_N, 0);
    EXPECT_EQ(holdOn(5, hands, {}, glm::vec3(0)).margin_N, 0) << "another fish is not pressed";
}

TEST(Script, NamesADiveFileBesideIt) {
    const tests::ScratchFolder folder;
    const std::string step = "[[step]]\ndo = \"wait\"\n";
    ASSERT_TRUE(writeFileWhole(folder / "s.toml", "dive = \"./own/cove.toml\"\n" + step));
    const auto script = loadScript(folder / "s.toml");
    ASSERT_TRUE(script) << script.error().message();
    EXPECT_EQ(Path(script->dive), folder / "own/cove.toml");
    EXPECT_FALSE(loadDiveFiles(script->dive)) << "there is no such file";
    EXPECT_EQ(cove().dive.name, (dataRoot() / "tests/playthrough/dive/cove.toml").string())
        << "by which a recording finds it again";
}

} // namespace
} // namespace shoal::game
