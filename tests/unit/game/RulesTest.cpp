// The rules of catching, one at a time.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <limits>

namespace shoal::game {
namespace {

using test::count;
using test::first;
using test::handAt;
using test::kPlace;
using test::OneFish;

TEST(Catching, ClosingOnAFishGrabsAndASecondLaterItCounts) {
    OneFish one;
    one.input.hands[1] = handAt(kPlace);
    one.step();
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    const Event* grab = first<EventKind::Grab>(one.events);
    ASSERT_NE(grab, nullptr);
    EXPECT_EQ(grab->hand, 1);
    EXPECT_EQ(grab->creature, 0);
    Snapshot now;
    one.world.snapshot(now);
    EXPECT_EQ(now.hands[1].holds, 0);
    EXPECT_EQ(now.creatures[0].heldBy, 1);
    EXPECT_EQ(now.creatures[0].gait.motion, Motion::Struggle);

    const uint64_t grabbed = one.tickOfFirst<EventKind::Grab>();
    while (one.world.state().totalTicks < grabbed + 119) one.step();
    EXPECT_EQ(count<EventKind::Catch>(one.events), 0);
    one.step();
    EXPECT_EQ(count<EventKind::Catch>(one.events), 1) << "120 ticks after the grab";
    EXPECT_EQ(one.world.score.caught, 1);
    EXPECT_EQ(one.world.score.points, one.world.species()[one.fish().species].points);
    one.step(30);
    EXPECT_EQ(count<EventKind::Release>(one.events), 1);
    EXPECT_EQ(count<EventKind::Escape>(one.events) + count<EventKind::Miss>(one.events), 0);
    EXPECT_EQ(one.world.hands[1].grasp.holds, -1);

    // It swims off, and for two seconds nobody catches it again.
    one.moveGrip(kPlace, 1, 0);
    EXPECT_GT(glm::distance(one.fish().position, kPlace), 0.1f);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    one.step(kCloseWindow);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 1);
    EXPECT_EQ(count<EventKind::Miss>(one.events), 1);
}

TEST(Catching, OpeningEarlyLetsItEscape) {
    OneFish one;
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(count<EventKind::Grab>(one.events), 1);
    one.step(60);
    one.moveGrip(kPlace, 1, 0);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 1);
    EXPECT_EQ(count<EventKind::Catch>(one.events), 0);
    EXPECT_EQ(one.world.score.points, 0);
}

TEST(Catching, ClosingOnNothingIsOneMiss) {
    OneFish one;
    const glm::vec3 elsewhere(0.4f, 0.2f, -0.5f);
    one.moveGrip(elsewhere, 0, 0);
    one.moveGrip(elsewhere, 0, 1);
    one.step(120);
    EXPECT_EQ(count<EventKind::Miss>(one.events), 1);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 0);
}

TEST(Catching, AFistThatMeetsAFishOnlyStartlesIt) {
    OneFish one;
    const glm::vec3 aside = kPlace + glm::vec3(0, 0, 0.35f);
    one.moveGrip(aside, 0, 0);
    one.moveGrip(aside, 0, 1);
    one.step(30);
    one.events.clear();
    one.rest();
    for (int i = 0; i <= 60; ++i) { // 0.8 m/s
        one.input.hands[1] =
            handAt(glm::mix(aside, kPlace - glm::vec3(0, 0, 0.05f), static_cast<float>(i) / 60), 1);
        one.step();
    }
    EXPECT_EQ(count<EventKind::Grab>(one.events), 0);
    EXPECT_GE(count<EventKind::Touch>(one.events), 1);
    EXPECT_EQ(count<EventKind::Startle>(one.events), 1);
    EXPECT_EQ(count<EventKind::Miss>(one.events), 0);
}

TEST(Catching, GripNeedsToCrossWithHysteresis) {
    OneFish one;
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.world.hands[1].grasp.holds, 0);
    // A trembling grip between the thresholds neither drops nor grabs anew.
    for (int i = 0; i < 40; ++i) {
        one.input.hands[1].grip = i % 2 ? kGripOpens + 0.02f : kGripCloses + 0.02f;
        one.step();
    }
    EXPECT_EQ(count<EventKind::Escape>(one.events), 0);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 1);
}

TEST(Catching, EachHandHoldsItsOwn) {
    OneFish one;
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.world.hands[1].grasp.holds, 0);
    // The left hand cannot take what the right one holds.
    for (int i = 0; i <= 15; ++i) {
        one.input.hands[0] = handAt(kPlace, static_cast<float>(i) / 15, 0);
        one.step();
    }
    EXPECT_EQ(one.world.hands[0].grasp.holds, -1);
    EXPECT_EQ(one.world.hands[1].grasp.holds, 0);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 1);
}

TEST(Catching, AHandThatVanishesKeepsItsFishForAMomentOnly) {
    OneFish one;
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.world.hands[1].grasp.holds, 0);
    one.input.hands[1].tracked = false;
    one.step(20);
    EXPECT_EQ(one.world.hands[1].grasp.holds, 0);
    one.step(60);
    EXPECT_EQ(one.world.hands[1].grasp.holds, -1);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 1);
}

TEST(Touching, AFastHandThatJumpsThroughAFishBetweenTwoTicksTouchesIt) {
    for (float speed : {5.0f, 20.0f, 60.0f}) {
        OneFish one;
        const glm::vec3 half(0.5f * speed / 120, 0, 0);
        one.input.hands[1] = handAt(kPlace - half, 1);
        one.world.fish[0].position = kPlace + glm::vec3(0, 3, 0); // out of the way while the hand appears
        one.step();
        one.rest();
        one.events.clear();
        one.input.hands[1] = handAt(kPlace + half, 1);
        one.step();
        EXPECT_GE(count<EventKind::Touch>(one.events), 1) << speed << " m/s";
        EXPECT_EQ(count<EventKind::Startle>(one.events), 1) << speed << " m/s";
    }
}

TEST(Touching, NoPushMakesAFishFasterThanThreeMetresASecond) {
    for (float speed : {1.0f, 4.0f, 20.0f, 100.0f})
        for (int round = 0; round < 8; ++round) {
            OneFish one;
            float fastest = 0;
            for (int i = 0; i < 60; ++i) {
                const float way =
                    std::fmod(speed * static_cast<float>(i) / 120 + 0.05f * static_cast<float>(round), 1.0f);
                one.input.hands[1] = handAt(kPlace + glm::vec3(way - 0.5f, 0, 0), round % 2 ? 1.0f : 0.0f);
                const glm::vec3 from = one.fish().position;
                one.step();
                if (one.fish().heldBy >= 0) break; // in a hand it goes where the hand goes
                fastest = std::max(fastest, glm::length(one.fish().velocity));
                // Position and velocity agree: no displacement beside the velocity. Half a millimetre a
                // second of rounding.
                EXPECT_LE(glm::distance(from, one.fish().position) * 120, kMaxSpeed_mps + 1e-3f);
            }
            EXPECT_LE(fastest, kMaxSpeed_mps + 1e-4f) << speed << " m/s";
        }
}

TEST(Touching, AGentleTouchPushesAway) {
    OneFish one;
    const glm::vec3 left = kPlace - glm::vec3(0.3f, 0, 0.02f); // the back of a right hand faces the fish
    one.input.hands[1] = handAt(left);
    one.step();
    one.rest();
    for (int i = 0; i <= 120 && !first<EventKind::Touch>(one.events); ++i) { // 0.2 m/s
        one.input.hands[1] = handAt(left + glm::vec3(0.2f * static_cast<float>(i) / 120, 0, 0));
        one.rest();
        one.step();
    }
    const Event* touch = first<EventKind::Touch>(one.events);
    ASSERT_NE(touch, nullptr);
    EXPECT_LT(touch->closing_mps, 0.25f);
    EXPECT_GE(touch->part, 0);
    EXPECT_LE(touch->part, hands::kPalmPart);
    EXPECT_EQ(count<EventKind::Startle>(one.events), 0);
    EXPECT_GT(one.fish().push.x, 0.03f) << "away from the hand";
    EXPECT_LT(glm::length(one.fish().push), 0.3f) << "gently";
}

TEST(Fright, AFastHandFrightensOnceAndTheFishCalmsDown) {
    OneFish one;
    one.input.hands[1] = handAt(kPlace + glm::vec3(0.45f, 0, 0));
    one.step();
    one.rest();
    for (int i = 1; i <= 20; ++i) { // 2 m/s towards it
        one.input.hands[1] = handAt(kPlace + glm::vec3(0.45f - 2.0f * static_cast<float>(i) / 120, 0, 0));
        one.step();
    }
    EXPECT_EQ(count<EventKind::Startle>(one.events), 1);
    EXPECT_EQ(one.fish().state, Fish::State::Dart);
    one.input.hands[1].tracked = false;
    one.step(480);
    EXPECT_EQ(one.fish().state, Fish::State::Cruise);
    EXPECT_LT(one.fish().speed, 0.3f);
    EXPECT_EQ(count<EventKind::Startle>(one.events), 1);
}

TEST(Fright, ASlowHandDoesNotFrighten) {
    OneFish one;
    for (int i = 0; i <= 90; ++i) { // 0.4 m/s from below, to where the palm nearly touches it
        one.rest();
        one.input.hands[1] =
            handAt(kPlace + glm::vec3(0.05f, -0.36f + 0.3f * static_cast<float>(i) / 90, 0.04f));
        one.step();
    }
    EXPECT_EQ(count<EventKind::Startle>(one.events), 0);
}

// Hands are given as the viewer has them: a head that leans takes them along.
TEST(Head, HandsGoWhereTheHeadGoes) {
    OneFish one;
    one.input.hands[1] = handAt(kPlace + glm::vec3(0.3f, 0, 0));
    one.step();
    const glm::vec3 before = one.world.hands[1].joints[10].position;
    one.input.headWorld = {0.2f, -0.1f, 0.05f};
    one.step();
    Snapshot shown;
    one.world.snapshot(shown);
    EXPECT_EQ(shown.headWorld, one.input.headWorld);
    EXPECT_LT(glm::distance(shown.hands[1].joints[10].position, before + one.input.headWorld), 1e-6f);
}

TEST(BadInput, IsNotBelieved) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    OneFish one;
    one.input.hands[1] = handAt(kPlace + glm::vec3(0.3f, 0, 0));
    one.step(2);
    const glm::vec3 good = one.world.hands[1].graspCentre;
    const auto bad = [&](auto spoil) {
        TickInput input = one.input;
        spoil(input);
        one.world.step(input, one.events);
        EXPECT_EQ(one.world.hands[1].graspCentre, good);
        EXPECT_TRUE(one.world.hands[1].visible);
        EXPECT_TRUE(std::isfinite(one.fish().position.x));
        one.step();
    };
    bad([&](TickInput& i) { i.hands[1].joints[4].position.x = nan; });
    bad([&](TickInput& i) { i.hands[1].joints[0].orientation.w = nan; });
    bad([&](TickInput& i) { i.hands[1].joints[20].position.y = 1e30f; });
    bad([&](TickInput& i) { i.hands[1].grip = nan; });
    bad([&](TickInput& i) { i.worldFromView = {nan, 0, 0, 0}; });
    bad([&](TickInput& i) { i.worldFromView = {0, 0, 0, 0}; });
    bad([&](TickInput& i) { i.headWorld = {nan, 0, 0}; });
    bad([&](TickInput& i) { i.headWorld = {0, 1e9f, 0}; });
    // For long: the hand is gone, nothing else happens.
    for (int i = 0; i < 200; ++i) {
        TickInput input = one.input;
        input.hands[1].joints[4].position.x = nan;
        one.world.step(input, one.events);
    }
    EXPECT_FALSE(one.world.hands[1].visible);
}

// Who cannot step or bend to a fish finds it above the lap, and nearer.
TEST(Seated, FishCircleWhereTheyAreReached) {
    const auto reef = loadDiveFiles("reef");
    ASSERT_TRUE(reef) << reef.error().message();
    struct Found {
        double belowLap = 0, radius_m = 0; // share, mean
        float lowest_m = 0;
    };
    const auto find = [&](bool seated) {
        DiveRules rules;
        rules.seated = seated;
        rules.freeSwim = true; // no shark frightens them
        Dive dive(reef->species, reef->dive, 3, rules);
        Events events;
        Found found;
        int count = 0;
        for (int tick = 0; tick < 60 * 120; ++tick) {
            dive.step({}, events);
            for (const Fish& fish : dive.state().fish) {
                found.belowLap += fish.position.y < -0.5f;
                found.radius_m += std::hypot(fish.position.x, fish.position.z);
                found.lowest_m = std::min(found.lowest_m, fish.position.y);
                ++count;
            }
        }
        found.belowLap /= count;
        found.radius_m /= count;
        return found;
    };
    const Found standing = find(false), seated = find(true);
    std::printf("below the lap %.1f and %.1f %%, radius %.2f and %.2f m, lowest %.2f and %.2f m\n",
                100 * standing.belowLap, 100 * seated.belowLap, standing.radius_m, seated.radius_m,
                static_cast<double>(standing.lowest_m), static_cast<double>(seated.lowest_m));
    EXPECT_LT(seated.belowLap, standing.belowLap / 4);
    EXPECT_LT(seated.radius_m, standing.radius_m - 0.1);
    EXPECT_GT(seated.lowest_m, -0.9f); // the floor of a room in which somebody sits
}

TEST(Course, DiveEndsInResultsAndRestartsWithTheNextSeed) {
    OneFish one;
    const int ticks = static_cast<int>(one.world.file().duration_s * 120);
    one.step(ticks - 1);
    EXPECT_EQ(one.world.state().phase, Phase::Diving);
    EXPECT_EQ(count<EventKind::DiveStart>(one.events), 1);
    one.step(2);
    EXPECT_EQ(one.world.state().phase, Phase::Results);
    EXPECT_EQ(count<EventKind::DiveOver>(one.events), 1);
    // In the results nothing is caught.
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 0);
    one.input.restart = true;
    one.step(50); // held down: one restart
    EXPECT_EQ(one.world.seed(), 6u);
    EXPECT_EQ(one.world.state().phase, Phase::Diving);
    EXPECT_EQ(one.world.state().tick, 50u);
    EXPECT_EQ(count<EventKind::DiveStart>(one.events), 2);
    EXPECT_EQ(one.world.score.points, 0);
}

TEST(Course, PauseFreezes) {
    OneFish one(true);
    one.step(10);
    one.input.pause = true;
    one.step();
    const uint64_t frozen = one.world.stateHash();
    const glm::vec3 at = one.fish().position;
    one.step(500);
    EXPECT_EQ(one.world.stateHash(), frozen);
    EXPECT_EQ(one.fish().position, at);
    Snapshot now;
    one.world.snapshot(now);
    EXPECT_TRUE(now.paused);
    one.input.pause = false;
    one.step();
    EXPECT_EQ(one.world.state().tick, 11u);
}

// Puts the shark there, prowling, looking at a place.
void placeShark(test::OpenDive& world, glm::vec3 at, glm::vec3 looking) {
    world.shark.position = at;
    world.shark.forward = glm::normalize(looking - at);
    world.shark.set(Shark::State::Prowl);
    world.shark.visit_s = 10;
}

TEST(SharkRules, TakesAStrugglingFishOutOfAHandAndLeaves) {
    OneFish one(true);
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    placeShark(one.world, {0.3f, -0.1f, -3.6f}, kPlace);
    // It points at the open hand before anything is in it.
    int threatened = 0;
    while (one.world.shark.state != Shark::State::Threaten || one.world.shark.aimed_s < 1.1f) {
        one.step();
        one.rest();
        ASSERT_LT(++threatened, 400);
    }
    const glm::vec3 toHand = one.world.hands[1].graspCentre - one.world.shark.position;
    EXPECT_GT(glm::dot(one.world.shark.forward, glm::normalize(toHand)), 0.9f);
    EXPECT_LT(one.world.shark.speed, 0.5f * one.world.species()[one.world.shark.species].cruise_mps);
    EXPECT_GT(one.world.shark.shape.finsDown, 0.5f) << "fins lowered";
    EXPECT_GT(one.world.shark.shape.bendUp, 0.3f) << "back arched";
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.world.hands[1].grasp.holds, 0);
    one.step(115);
    const Event* steal = first<EventKind::SharkSteal>(one.events);
    ASSERT_NE(steal, nullptr);
    EXPECT_EQ(steal->hand, 1);
    EXPECT_EQ(one.world.score.lost, 1);
    EXPECT_EQ(one.world.score.caught, 0);
    EXPECT_EQ(one.world.hands[1].grasp.holds, -1);
    EXPECT_EQ(one.world.shark.state, Shark::State::Leave);
    one.input.hands[1].tracked = false;
    one.step(1800);
    EXPECT_EQ(one.world.shark.mouth, -1);
    EXPECT_EQ(one.fish().state, Fish::State::Cruise) << "it got away and came back";
    EXPECT_EQ(count<EventKind::SharkSteal>(one.events), 1);
}

// Whoever holds one fish after the other before a shark: it points at the hand for a second before each
// strike.
TEST(SharkRules, NeverStrikesUnannounced) {
    int strikes = 0;
    for (const glm::vec3 at : {glm::vec3(0.3f, -0.1f, -3.2f), glm::vec3(2.2f, -0.1f, -1.6f)}) {
        OneFish one(true);
        placeShark(one.world, at, kPlace);
        int aimed = 0;
        for (int i = 0; i < 1200; ++i) {
            const int cycle = i % 160; // the hand is closed for 1.2 s, open for 0.13 s
            if (cycle == 0) {
                one.rest();
                one.fish().uncatchable_s = 0;
            }
            one.input.hands[1] = handAt(kPlace, cycle < 144 ? 1.0f : 0.0f);
            const bool before = one.world.shark.state == Shark::State::Strike;
            one.step();
            const glm::vec3 to = one.world.hands[1].graspCentre - one.world.shark.position;
            if (!before && one.world.shark.state == Shark::State::Strike) {
                ++strikes;
                EXPECT_GE(aimed, 120) << "ticks, at tick " << i;
            }
            const bool points = one.world.shark.state == Shark::State::Threaten &&
                                glm::dot(one.world.shark.forward, glm::normalize(to)) > 0.9f;
            aimed = points ? aimed + 1 : 0;
        }
    }
    EXPECT_GE(strikes, 2);
}

TEST(SharkRules, ABumpDropsWhatTheHandHolds) {
    OneFish one(true);
    one.moveGrip(kPlace, 0, 0);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.world.hands[1].grasp.holds, 0);
    // Its flank comes upon the hand while it is after nothing.
    one.world.shark.position = kPlace + glm::vec3(0.25f, 0, -0.1f);
    one.world.shark.forward = {0, 0, -1};
    one.world.shark.set(Shark::State::Leave);
    one.step();
    EXPECT_EQ(count<EventKind::SharkBump>(one.events), 1);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 1);
    EXPECT_EQ(one.world.hands[1].grasp.holds, -1);
    one.step(60);
    EXPECT_EQ(count<EventKind::SharkBump>(one.events), 1) << "one bump, not one a tick";
}

TEST(SharkRules, VisitsAreAnnounced) {
    OneFish one(true);
    one.step(90 * 120);
    EXPECT_EQ(count<EventKind::SharkNear>(one.events),
              static_cast<int>(one.world.file().shark.visits_s.size()));
    const Event* near = first<EventKind::SharkNear>(one.events);
    ASSERT_NE(near, nullptr);
    EXPECT_EQ(near->creature, 1);
    EXPECT_NEAR(static_cast<float>(one.tickOfFirst<EventKind::SharkNear>()) / 120,
                one.world.file().shark.visits_s[0], 0.02f);
}

} // namespace
} // namespace shoal::game
