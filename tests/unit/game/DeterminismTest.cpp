// Equal inputs give equal states in all runs and recordings.
#include "Fixture.h"
#include "game/rules/ReachHelp.h"
#include "tests/Recorded.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::cove;
using test::rig;

Script busyScript() {
    auto loaded = loadScript(dataRoot() / "tests/playthrough/two_hands.toml");
    if (!loaded) throw std::runtime_error(loaded.error().message());
    return *loaded;
}

TEST(Determinism, TwoDivesWithTheSameSeedAgreeAtEveryTickAndOthersDoNot) {
    Dive a(cove().species, cove().dive, 11), b(cove().species, cove().dive, 11),
        c(cove().species, cove().dive, 12);
    Events events;
    EXPECT_EQ(a.stateHash(), b.stateHash());
    for (int i = 0; i < 2400; ++i) {
        TickInput input;
        input.hands[1] =
            test::handAt({0.3f * static_cast<float>(i % 100) / 100, 0, -0.6f}, i % 60 < 30 ? 0.0f : 1.0f);
        input.hands[0] = test::handAt({-0.2f, 0, -0.6f}, i % 80 < 40 ? 0.0f : 1.0f, 0);
        input.hands[0].solid = i % 700 > 40;
        a.step(input, events);
        b.step(input, events);
        c.step(input, events);
        ASSERT_EQ(a.stateHash(), b.stateHash()) << "tick " << i;
        ASSERT_NE(a.stateHash(), c.stateHash());
    }
}

TEST(Determinism, AReplayedInputOfOtherBitsIsFoundAtItsTick) {
    const Played played = playScript(busyScript(), rig(), cove());
    const tests::Recorded& good = played.recording;
    ASSERT_TRUE(replay(good, cove()));
    tests::Recorded bad(good.header());
    for (size_t tick = 0; tick < good.ticks(); ++tick) {
        std::vector<uint8_t> input(good.input(tick).begin(), good.input(tick).end());
        if (tick == 321) {
            TickInput changed = tests::inputAt(good, tick);
            changed.hands[0].joints[7].position.x += 1e-6f;
            toBytes(changed, std::span(input).first<kTickInputBytes>());
        }
        bad.add(input, good.hash(tick));
    }
    const Status status = replay(bad, cove());
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().reason.find("tick 321"), std::string::npos) << status.error().reason;
}

// Every field of the state counts: changing any one changes the hash.
TEST(Determinism, TheHashDependsOnSmallPartsOfTheState) {
    test::OpenDive dive(cove().species, cove().dive, 3);
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
    TickInput in;
    in.hands[0] = test::handAt({0.1f, 0.2f, -0.5f}, 0.3f, 0);
    in.hands[1] = test::handAt({-0.1f, -0.2f, -0.9f}, 0.9f);
    in.worldFromView = {0.5f, -0.5f, 0.5f, 0.5f};
    in.headWorld = {0.1f, -0.2f, 0.3f};
    in.restart = true;
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
    Dive dive(cove().species, cove().dive, 4);
    Events events;
    Snapshot a, b, mid;
    for (int i = 0; i < 30; ++i) dive.step({}, events);
    dive.snapshot(a);
    dive.step({}, events);
    dive.snapshot(b);
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

TEST(ReachHelp, FindsTheFishUnderTheCursor) {
    Dive dive(cove().species, cove().dive, 4);
    Snapshot now;
    dive.snapshot(now);
    for (CreatureView& c : now.creatures) c.position = {0, 0, 2};
    now.creatures[0].position = {0.2f, 0, -0.8f};
    const glm::vec3 ray = glm::normalize(now.creatures[0].position);
    now.creatures[0].velocity = glm::vec3(0);
    ReachHelp help;
    const auto reach_m = help.update(now, cove().species, ray, 0.5f);
    ASSERT_TRUE(reach_m);
    EXPECT_NEAR(*reach_m, glm::length(now.creatures[0].position), 1e-5f);
    EXPECT_FALSE(help.update(now, cove().species, {-1, 0, 0}, 0.5f));
}

} // namespace
} // namespace shoal::game
