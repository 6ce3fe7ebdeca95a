// Parts of the simulation one by one, each given its inputs by hand.
#include "Fixture.h"
#include "engine/core/WriteFile.h"

#include "game/rules/Catching.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/HandTracking.h"
#include "game/rules/Holding.h"
#include "game/rules/SharkBehaviour.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::count;
using test::cove;
using test::handAt;

constexpr glm::vec3 kHandPlace(0, -0.1f, -0.6f);

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
    for (Fish& f : fish) f.leader = 0;
    fish[1].leader = leaderOfSecond;
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
}

TEST(Schooling, AFishInAHandIsNoCompany) {
    const SpeciesTable species(1);
    std::vector<Neighbours> around(2);
    std::vector<Fish> fish = pair(0.15f, 0);
    fish[1].state = Fish::State::Held;
    gatherNeighbours(fish, species, around);
    EXPECT_EQ(around[0].giveWay, glm::vec3(0));
    EXPECT_EQ(around[0].aligned, 0);
}

TEST(HandTracking, ALostHandStaysForATenthOfASecondAndAJumpGivesNoSpeed) {
    TickInput input;
    Viewpoint view;
    Hands hands;
    input.hands[1] = handAt(kHandPlace);
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

TEST(ClosingHands, AnEmptyOneMissesOnceAfterItsWindow) {
    TickInput input;
    Viewpoint view;
    Hands hands;
    Events out;
    Events& events = out;
    std::vector<Fish> none;
    for (int tick = 0; tick < 60; ++tick) {
        input.hands[1] = handAt(kHandPlace, std::min(1.0f, static_cast<float>(tick) / 15));
        trackHands(input, view, hands);
        closeHands(hands, none, {.species = cove().species, .contacts = {}, .view = view}, events);
    }
    EXPECT_EQ(count<EventKind::Miss>(out), 1);
    EXPECT_TRUE(hands[1].grasp.closed);
    out.clear();
    input.hands[1] = handAt(kHandPlace, 0);
    trackHands(input, view, hands);
    closeHands(hands, none, {.species = cove().species, .contacts = {}, .view = view}, events);
    EXPECT_FALSE(hands[1].grasp.closed);
    EXPECT_TRUE(out.empty());
}

TEST(FingerWrap, FingersPressOnWhatLiesInTheFistFromBothSides) {
    TickInput input;
    Viewpoint view;
    Hands hands;
    input.hands[1] = handAt(kHandPlace, 1);
    trackHands(input, view, hands);
    const physics::Capsule fish{kHandPlace - glm::vec3(0.03f, 0, 0), kHandPlace + glm::vec3(0.03f, 0, 0),
                                0.024f};
    wrapFingers(fish, hands[1]);
    EXPECT_GT(hands[1].fingers.pressCount, 2);
    hands[1].grasp.encloses = 4;
    EXPECT_GT(holdOn(4, hands, {}, glm::vec3(0)).margin_N, 0);
    EXPECT_EQ(holdOn(5, hands, {}, glm::vec3(0)).margin_N, 0) << "another fish is not pressed";
}

// A shark before a hand, and what it decides within some seconds.
struct SharkBeforeHand {
    DiveFile dive = cove().dive;
    Hands hands;
    std::vector<Fish> fish{Fish{}};
    Shark shark;
    Events out;

    SharkBeforeHand() {
        shark.present = true;
        shark.species = dive.shark.species;
        hands[1].visible = true;
        hands[1].graspCentre = kHandPlace;
        shark.position = {0, -0.1f, -3.2f};
        shark.forward = {0, 0, 1}; // its mouth is 1.6 m away from the hand
    }
    void decideAt(float time_s, int ticks = 1, bool over = false) {
        Events& events = out;
        for (int i = 0; i < ticks; ++i)
            decide(shark, {dive, cove().species, hands, fish, time_s, over}, events);
    }
};

TEST(SharkBehaviour, VisitsAtItsTimesButNotAfterTheDive) {
    SharkBeforeHand one;
    one.decideAt(one.dive.shark.visits_s[0] - 1);
    EXPECT_EQ(one.shark.state, Shark::State::Circle);
    one.decideAt(one.dive.shark.visits_s[0]);
    EXPECT_EQ(one.shark.state, Shark::State::Prowl);
    EXPECT_EQ(count<EventKind::SharkNear>(one.out), 1);
    SharkBeforeHand late;
    late.decideAt(one.dive.shark.visits_s[0], 1, true);
    EXPECT_EQ(late.shark.state, Shark::State::Circle);
}

TEST(SharkBehaviour, StrikesOnlyAfterItHasAimedAtAStrugglingFish) {
    SharkBeforeHand one;
    one.shark.set(Shark::State::Prowl);
    one.shark.visit_s = 10;
    one.decideAt(30);
    ASSERT_EQ(one.shark.state, Shark::State::Threaten);
    one.hands[1].grasp.holds = 0;
    one.fish[0].state = Fish::State::Held;
    one.fish[0].held_s = 0.2f;
    int ticks = 0;
    for (; one.shark.state == Shark::State::Threaten && ticks < 1000; ++ticks) one.decideAt(30);
    EXPECT_EQ(one.shark.state, Shark::State::Strike);
    EXPECT_NEAR(static_cast<float>(ticks) * kDt, kAim_s, 2 * kDt);
    one.fish[0].counted = true; // it has become a catch: too late
    one.decideAt(30);
    EXPECT_EQ(one.shark.state, Shark::State::Prowl);
    EXPECT_EQ(one.shark.prey, -1);
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
