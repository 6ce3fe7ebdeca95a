// Bending and tail beats of bodies, compared with what is known of fish.
#include "Fixture.h"

#include "game/rules/Swimmer.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::cove;
using test::OneFish;

// A beat carries a body on by its stride, whatever its speed (Bainbridge 1958); some kinds glide between
// beats.
TEST(Tail, BeatsOnceForEachStrideAndRestsWhileItsKindGlides) {
    test::OpenDive world(cove().species, test::calmCove(), 6);
    Events events;
    std::vector<double> swum_m(world.fish.size(), 0);
    std::vector<int> gliding(world.fish.size(), 0);
    for (int i = 0; i < 30 * 120; ++i) {
        world.step({}, events);
        for (size_t f = 0; f < world.fish.size(); ++f) {
            swum_m[f] += static_cast<double>(world.fish[f].speed) * kDt;
            gliding[f] += world.fish[f].route.gliding && world.fish[f].shape.amplitude < 0.02f;
        }
    }
    for (size_t f = 0; f < world.fish.size(); ++f) {
        const Species& kind = world.species()[world.fish[f].species];
        const double strides = swum_m[f] / static_cast<double>(kind.stride * kind.length_m);
        // 3600 additions to a float of up to 200: each rounds by 2^-17 at most, 0.03 in all.
        EXPECT_NEAR(static_cast<double>(world.fish[f].shape.beats), strides, 0.05) << kind.name;
        if (kind.coasts)
            EXPECT_GT(gliding[f], 120) << kind.name;
        else
            EXPECT_EQ(gliding[f], 0) << kind.name;
    }
}

TEST(Tail, SwingsWiderTheFasterItSwimsUpToATenthOfTheLength) {
    float before = 0;
    for (float pace : {0.1f, 0.5f, 1.0f, 2.0f, 5.0f, 50.0f}) {
        EXPECT_GT(tailAmplitude(pace), before);
        before = tailAmplitude(pace);
    }
    EXPECT_EQ(tailAmplitude(0), 0);
    EXPECT_LT(before, kFullBeat);
    EXPECT_GT(before, 0.99f * kFullBeat);
    EXPECT_EQ(tailBeat_Hz(100, 0.1f, 0.65f), kFastestBeat_Hz);
    EXPECT_FLOAT_EQ(tailBeat_Hz(0.65f, 0.5f, 0.65f), 2);
}

// Headings have inertia, bodies lie along their curved ways, and lean into them.
TEST(Turning, IsSmoothAndBendsAndBanksTheBodyInwards) {
    test::OpenDive world(cove().species, test::calmCove(), 2);
    Events events;
    std::vector<glm::vec3> forward, turned;
    int inwards = 0, outwards = 0, leaning = 0, upright = 0;
    for (int i = 0; i < 40 * 120; ++i) {
        forward.resize(world.fish.size());
        turned.resize(world.fish.size());
        for (size_t f = 0; f < world.fish.size(); ++f) forward[f] = world.fish[f].forward;
        world.step({}, events);
        for (size_t f = 0; f < world.fish.size(); ++f) {
            const Fish& fish = world.fish[f];
            const Species& kind = world.species()[fish.species];
            const glm::vec3 rate = (fish.forward - forward[f]) / kDt;
            ASSERT_LT(glm::length(rate), 1.01f * kind.turn_radps) << kind.name;
            // The limit of turn(), and 4 % for float headings: a difference of two of 1e-7 each over dt^2.
            if (i > 0) {
                ASSERT_LT(glm::length(rate - turned[f]) / kDt, 9 * kind.turn_radps * 1.04f + 10) << i;
            }
            turned[f] = rate;
            const float yaw = glm::dot(rate, leftOf(forward[f]));
            if (std::fabs(yaw) < 0.5f) continue;
            ++(yaw * fish.shape.bendLeft > 0 ? inwards : outwards);
            ++(yaw * fish.bank > 0 ? leaning : upright);
        }
    }
    ASSERT_GT(inwards, 1000);
    EXPECT_GT(inwards, 9 * outwards);
    EXPECT_GT(leaning, 5 * upright);
}

TEST(Facing, FishLookWhereTheyGo) {
    double off = 0, all = 0, sum = 0;
    for (uint64_t seed : {1, 2, 3}) {
        test::OpenDive world(cove().species, cove().dive, seed); // shark and all
        Events events;
        for (int i = 0; i < 60 * 120; ++i) {
            world.step({}, events);
            for (const Fish& fish : world.fish) {
                const float speed = glm::length(fish.velocity);
                if (speed < 0.1f) continue;
                const float facing = glm::dot(fish.forward, fish.velocity) / speed;
                ++all;
                off += facing < 0.94f; // 20 degrees
                sum += static_cast<double>(facing);
            }
        }
    }
    EXPECT_GT(sum / all, 0.995);
    EXPECT_LT(off, 0.005 * all); // fish that others push
}

// Domenici & Blake 1997: the body snaps into a C, turns away, drives off.
TEST(Flight, BeginsWithACThenSpeedsAwayThenCalmsDown) {
    for (const glm::vec3 from : {glm::vec3(0.2f, 0, 0), glm::vec3(0, 0, 0.2f), glm::vec3(0.15f, 0, 0.15f)}) {
        OneFish one;
        one.fish().route.cruise_mps = 0.25f;
        one.fish().speed = 0.25f;
        one.step(12);
        const glm::vec3 threat = one.fish().position + from;
        one.world.startle(0, threat, one.events);
        const float dart = one.world.species()[one.fish().species].dart_mps;
        float bend = 0, fastest = 0;
        int atFullSpeed = 0, turnedAway = 0;
        for (int i = 1; i <= 60; ++i) {
            one.step();
            if (i <= 12) bend = std::max(bend, std::fabs(one.fish().shape.bendLeft));
            fastest = std::max(fastest, one.fish().speed);
            if (!turnedAway && glm::dot(one.fish().forward, one.fish().flight.heading) > 0.8f) turnedAway = i;
            if (!atFullSpeed && one.fish().speed > 0.85f * dart) atFullSpeed = i;
        }
        EXPECT_GT(bend, 1.3f);
        EXPECT_GT(turnedAway, 0);
        EXPECT_LT(turnedAway, 30) << "on its way within 0.25 s, even from straight ahead";
        EXPECT_GT(atFullSpeed, 0);
        EXPECT_LT(atFullSpeed, 30) << "at full speed within 0.25 s";
        EXPECT_GT(glm::distance(one.fish().position, threat), 0.5f);
        one.step(4 * 120);
        EXPECT_EQ(one.fish().state, Fish::State::Cruise);
        EXPECT_LT(one.fish().speed, 1.5f * one.fish().route.cruise_mps);
    }
}

TEST(Held, CurlsAwayFromThePalmAndStrugglesInBouts) {
    OneFish one;
    one.takeFish();
    one.step(24); // it lies in the palm
    int bouts = 0, away = 0, ticks = 0;
    bool wild = one.fish().shape.amplitude > 0.08f;
    for (; one.held() == 0 && ticks < 200; ++ticks) {
        one.step();
        const BodyShape& shape = one.fish().shape;
        if (!wild && shape.amplitude > 0.08f) ++bouts;
        if (shape.amplitude > 0.08f || shape.amplitude < 0.05f) wild = shape.amplitude > 0.08f;
        // The side to which both its ends go, against the side of the palm.
        const glm::vec3 ends = one.fish().worldFromBody * glm::vec3(shape.bendLeft, shape.bendUp, 0);
        const glm::vec3 outOfPalm = one.world.hands[1].joints[0].orientation * glm::vec3(0, -1, 0);
        away += glm::dot(ends, outOfPalm) > 0.3f;
    }
    EXPECT_GT(ticks, 60);
    EXPECT_GE(bouts, 1);
    EXPECT_GT(away, 0.8 * ticks);
}

} // namespace
} // namespace shoal::game
