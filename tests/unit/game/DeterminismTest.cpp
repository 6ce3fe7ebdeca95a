// Equal inputs, equal states: over runs, over recordings, over display rates.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::reef;
using test::rig;

Script busyScript() {
    auto loaded = loadScript(dataRoot() / "tests/playthrough/two_hands.toml");
    if (!loaded) throw std::runtime_error(loaded.error().sentence());
    return *loaded;
}

TEST(Determinism, TwoDivesWithTheSameSeedAgreeAtEveryTickAndOthersDoNot) {
    Dive a(reef().species, reef().dive, 11), b(reef().species, reef().dive, 11),
        c(reef().species, reef().dive, 12);
    std::vector<Event> events;
    EXPECT_EQ(a.stateHash(), b.stateHash());
    for (int i = 0; i < 2400; ++i) {
        TickInput input;
        input.hands[1] =
            test::handAt({0.3f * static_cast<float>(i % 100) / 100, 0, -0.6f}, i % 60 < 30 ? 0.0f : 1.0f);
        a.step(input, events);
        b.step(input, events);
        c.step(input, events);
        ASSERT_EQ(a.stateHash(), b.stateHash()) << "tick " << i;
        ASSERT_NE(a.stateHash(), c.stateHash());
    }
}

TEST(Determinism, AReplayedInputOfOtherBitsIsFoundAtItsTick) {
    const Played played = playScript(busyScript(), rig(), reef());
    const sim::Recording& good = played.recording;
    ASSERT_TRUE(replay(good, reef()));
    sim::Recording bad(good.header());
    for (size_t tick = 0; tick < good.ticks(); ++tick) {
        std::vector<uint8_t> input(good.input(tick).begin(), good.input(tick).end());
        if (tick == 321) {
            TickInput changed = fromBytes(good.input(tick).first<kTickInputBytes>());
            changed.hands[0].joints[7].position.x += 1e-6f;
            toBytes(changed, std::span(input).first<kTickInputBytes>());
        }
        bad.add(input, good.hash(tick));
    }
    const Status status = replay(bad, reef());
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().reason.find("tick 321"), std::string::npos) << status.error().reason;
}

// The same player before displays of different speed, one of them stumbling over a frame of 300 ms.
TEST(Determinism, DisplayRateDoesNotMatter) {
    const Script script = busyScript();
    const auto play = [&](int fps) {
        Dive dive(reef().species, reef().dive, script.seed);
        ScriptRun run(script, rig(), reef().species);
        sim::FixedStep clock;
        Snapshot before, now, shown;
        std::vector<Event> events;
        TickInput input;
        dive.snapshot(now);
        for (int frame = 0; !run.finished() && frame < 100'000; ++frame) {
            const int ticks = clock.advance(frame == fps ? 0.3 : 1.0 / fps);
            for (int i = 0; i < ticks && !run.finished(); ++i) {
                before = now;
                run.next(now, input);
                events.clear();
                dive.step(input, events);
                dive.snapshot(now);
                run.observe(events, now);
            }
            if (before.creatures.size())
                interpolate(before, now, clock.alpha(), shown); // what a display would do
        }
        EXPECT_TRUE(run.finished());
        return std::pair(dive.stateHash(), run.ticks());
    };
    const auto reference = play(60);
    for (int fps : {24, 30, 90, 120, 144}) EXPECT_EQ(play(fps), reference) << fps << " frames a second";
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
    Dive dive(reef().species, reef().dive, 4);
    std::vector<Event> events;
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

TEST(ReachAssist, FindsTheFishUnderTheCursor) {
    Dive dive(reef().species, reef().dive, 4);
    Snapshot now;
    dive.snapshot(now);
    for (CreatureView& c : now.creatures) c.position = {0, 0, 2};
    now.creatures[0].position = {0.2f, 0, -0.8f};
    const glm::vec3 ray = glm::normalize(now.creatures[0].position);
    EXPECT_NEAR(reachAssist(now, reef().species, ray), glm::length(now.creatures[0].position), 1e-5f);
    EXPECT_LT(reachAssist(now, reef().species, {-1, 0, 0}), 0);
}

} // namespace
} // namespace shoal::game
