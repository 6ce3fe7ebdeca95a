// Parts of the simulation one by one, each given its inputs by hand.
#include "Fixture.h"
#include "tests/unit/Heap.h"

namespace shoal::game {
namespace {

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
    EXPECT_NEAR(glm::distance(swimmer.worldFromBody * glm::vec3(0, 0, 1), swimmer.forward), 0, 1e-6f);
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
    input.hands[1] = handAt(kPlace);
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
    DiveState state;
    Hands& hands = state.hands;
    input.hands[1] = handAt(kPlace, 1);
    trackHands(input, view, hands);
    const physics::Capsule fish{kPlace - glm::vec3(0.03f, 0, 0), kPlace + glm::vec3(0.03f, 0, 0), 0.024f};
    wrapFingers(fish, hands[1]);
    EXPECT_GT(hands[1].fingers.pressCount, 2);
    hands[1].grasp.encloses = 4;
    EXPECT_GT(holdOn(4, state, glm::vec3(0)).margin_N, 0);
    EXPECT_EQ(holdOn(5, state, glm::vec3(0)).margin_N, 0) << "another fish is not pressed";
}

// Every field of the state counts: changing any one changes the hash.
TEST(Determinism, TheHashDependsOnSmallPartsOfTheState) {
    OpenDive dive(cove().species, cove().dive, 3);
    const auto changes = [&](auto& value, auto to) {
        const auto was = value;
        const uint64_t before = dive.stateHash();
        value = to;
        EXPECT_NE(dive.stateHash(), before);
        value = was;
        EXPECT_EQ(dive.stateHash(), before);
    };
    changes(dive.fish[5].touchedUntil[1][3], 77u);
    changes(dive.fish[2].gait.blend, 0.5f);
    changes(dive.shark.shape.finsDown, 0.25f);
    changes(dive.hands[1].lastGood.joints[7].orientation.z, 0.125f);
    changes(dive.hands[0].fingers.lifts[25].move.y, 0.5f);
    changes(dive.hands[0].grasp.window, 3);
    changes(dive.state().random, Random(99, 1));
    changes(dive.state().score.lost, 1);
}

TEST(TickInput, ComesBackFromBytesExactly) {
    const TickInput in{.hands = {handAt({0.1f, 0.2f, -0.5f}, 0.3f, 0), handAt({-0.1f, -0.2f, -0.9f}, 0.9f)},
                       .worldFromView = {0.5f, -0.5f, 0.5f, 0.5f},
                       .headWorld = {0.1f, -0.2f, 0.3f},
                       .restart = true};
    std::array<uint8_t, kTickInputBytes> bytes{}, again{};
    toBytes(in, bytes);
    const TickInput out = fromBytes(bytes);
    toBytes(out, again);
    EXPECT_EQ(bytes, again);
    EXPECT_EQ(out.hands[1].joints[13].position, in.hands[1].joints[13].position);
    EXPECT_EQ(out.headWorld, in.headWorld);
    EXPECT_TRUE(out.restart);
    EXPECT_FALSE(out.pause);
}

TEST(Interpolate, LiesBetweenAndDoesNotSmearJumps) {
    OpenDive dive(cove().species, cove().dive, 4);
    dive.step(30);
    const Snapshot a = dive.shown();
    dive.step();
    Snapshot b = dive.shown(), mid;
    interpolate(a, b, 0.25f, mid);
    for (size_t i = 0; i < a.creatures.size(); ++i) {
        const glm::vec3 expected = 0.75f * a.creatures[i].position + 0.25f * b.creatures[i].position;
        EXPECT_NEAR(glm::distance(mid.creatures[i].position, expected), 0, 1e-5f);
        EXPECT_NEAR(glm::length(mid.creatures[i].worldFromBody), 1, 1e-5f);
    }
    b.creatures[3].position += glm::vec3(2, 0, 0);
    interpolate(a, b, 0.25f, mid);
    EXPECT_EQ(mid.creatures[3].position, b.creatures[3].position);
    // At the ends: exactly the snapshots' places.
    interpolate(a, b, 0, mid);
    EXPECT_EQ(mid.creatures[5].position, a.creatures[5].position);
}

TEST(Allocation, ATickTakesNoMemory) {
    Dive dive(cove().species, cove().dive, 2);
    Snapshot a, b, shown;
    Events events;
    events.reserve(1000);
    TickInput input;
    dive.snapshot(a);
    dive.snapshot(b);
    interpolate(a, b, 0.5f, shown);
    for (int i = 0; i < 6000; ++i) {
        if (i == 120) heap::counting = true; // scratch memory has its size
        events.clear();
        // Hands that swing and close, so that contacts and grabs happen; one of them gets lost at times.
        const float x = static_cast<float>(i % 240) / 240 - 0.5f;
        input.hands[1] = handAt({x, -0.1f, -0.8f}, i % 90 < 45 ? 0.0f : 1.0f);
        input.hands[0] = handAt({-x, 0, -0.7f}, i % 70 < 45 ? 0.0f : 1.0f, 0);
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
