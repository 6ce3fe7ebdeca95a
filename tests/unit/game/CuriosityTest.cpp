// Fish that come to look at a hand that rests.
#include "Fixture.h"

#include "game/rules/FishBehaviour.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::cove;
using test::handAt;

// The cove without its shark, and a right hand that rests in view from the start.
struct RestingHand {
    test::OpenDive world;
    TickInput input;
    Events events;

    explicit RestingHand(uint64_t seed) : world(cove().species, test::calmCove(), seed) {
        input.hands[1] = handAt({0.05f, -0.1f, -0.7f});
    }
    int visitors() const {
        return static_cast<int>(
            std::ranges::count_if(world.fish, [](const Fish& f) { return f.visit.hand == 1; }));
    }
    float nearest() const {
        float least = 10;
        for (const Fish& f : world.fish)
            least = std::min(least, glm::distance(f.position, visitedPlace(world.hands[1])));
        return least;
    }
    void step(int ticks) {
        for (int i = 0; i < ticks; ++i) world.step(input, events);
    }
};

TEST(Curiosity, FishComeOneOrTwoAtATimeLingerAndLeave) {
    int dives = 0;
    for (uint64_t seed : {1, 2, 3, 4}) {
        RestingHand one(seed);
        int most = 0, there = 0;
        std::vector<bool> came(one.world.fish.size());
        for (int i = 0; i < 30 * 120; ++i) {
            one.step(1);
            most = std::max(most, one.visitors());
            there += one.nearest() < 0.1f;
            for (size_t f = 0; f < came.size(); ++f) came[f] = came[f] || one.world.fish[f].visit.hand == 1;
            if (i == 100) {
                EXPECT_EQ(most, 0) << "nobody comes within the first second";
            }
        }
        EXPECT_GE(most, 1);
        EXPECT_LE(most, 2);
        EXPECT_GE(std::ranges::count(came, true), 3) << "in turns, seed " << seed;
        dives += there > 3 * 120;
    }
    EXPECT_GE(dives, 3) << "of 30 s, somebody is before the palm for more than three";
}

TEST(Curiosity, AFastHandEndsAVisit) {
    RestingHand one(2);
    int ticks = 0;
    while (one.visitors() == 0 && ++ticks < 1200) one.step(1);
    ASSERT_GT(one.visitors(), 0);
    for (int i = 0; i < 24; ++i) { // 1 m/s
        one.input.hands[1] = handAt({0.05f - 0.2f * static_cast<float>(i) / 24, -0.1f, -0.7f});
        one.step(1);
    }
    EXPECT_EQ(one.visitors(), 0);
}

TEST(Curiosity, OnlyAnOpenHandInViewIsVisitedAndOnlyByTheCurious) {
    for (const hands::HandPose& hand : {handAt({0.05f, -0.1f, -0.7f}, 1), handAt({0.45f, -0.35f, -0.4f})}) {
        RestingHand one(3);
        one.input.hands[1] = hand;
        one.step(10 * 120);
        EXPECT_EQ(one.visitors(), 0);
    }
    SpeciesTable dull = cove().species;
    for (Species& kind : dull) kind.curiosity = 0;
    test::OpenDive world(dull, test::calmCove(), 3);
    TickInput input;
    input.hands[1] = handAt({0.05f, -0.1f, -0.7f});
    world.run(10, input);
    for (const Fish& f : world.fish) EXPECT_EQ(f.visit.hand, -1);
}

} // namespace
} // namespace shoal::game
