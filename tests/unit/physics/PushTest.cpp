#include "engine/physics/ContactWorld.h"

#include "engine/core/Random.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::physics {
namespace {

Contact against(glm::vec3 normal, glm::vec3 moverVelocity = glm::vec3(0), float depth = 0) {
    Contact c;
    c.normal = glm::normalize(normal);
    c.moverVelocity = moverVelocity;
    c.depth = depth;
    c.lasting = true;
    return c;
}

TEST(Push, ABoneTakesAlongWhatItMeetsAndDoesNotBounceIt) {
    const Contact c = against({1, 0, 0}, {2, 5, 0});
    const glm::vec3 v = pushed({-1, 0.3f, 0}, {&c, 1});
    EXPECT_NEAR(v.x, 2, 3 * kSoftness); // all but the softness of it: a change of 3 m/s
    EXPECT_LE(v.x, 2);
    EXPECT_EQ(v.y, 0.3f) << "no friction on what swims free";
    // A body that leaves already is not pushed.
    EXPECT_EQ(pushed({3, 0, 0}, {&c, 1}), glm::vec3(3, 0, 0));
}

TEST(Push, AgainstBonesAtRestNothingGainsSpeed) {
    Random random(3, 1);
    for (int round = 0; round < 5000; ++round) {
        std::vector<Contact> contacts;
        const int count = 1 + static_cast<int>(random.below(48));
        for (int i = 0; i < count; ++i)
            contacts.push_back(
                against({random.between(-1, 1), random.between(-1, 1), random.between(0.1f, 1)}, glm::vec3(0),
                        random.between(0, 0.05f)));
        if (round % 2)
            for (size_t i = 0; i < contacts.size(); i += 2) contacts[i].normal = -contacts[i].normal;
        const glm::vec3 v(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
        // The solver descends on |v|^2 + softness: rounding of some hundred additions is all that may be
        // added.
        EXPECT_LE(glm::length(pushed(v, contacts)), glm::length(v) * (1 + 1e-5f)) << round;
    }
}

TEST(Push, BetweenTwoHandsThatCloseItComesToRest) {
    const Contact both[] = {against({1, 0, 0}, {1, 0, 0}, 0.01f), against({-1, 0, 0}, {-1, 0, 0}, 0.01f)};
    const glm::vec3 v = pushed({0.4f, 0, 0}, both);
    EXPECT_LT(glm::length(v), 0.5f) << "neither wins";
    EXPECT_LT(glm::length(separating(both)), 0.1f) << "and it is not spat out";
}

TEST(Separating, IsGentleAndFadesWithTheOverlap) {
    float before = 10;
    for (float depth : {0.06f, 0.03f, 0.01f, 0.002f, 0.0005f}) {
        const Contact c = against({0, 1, 0}, {0, 20, 0}, depth);
        const float speed = glm::length(separating({&c, 1}));
        EXPECT_LE(speed, kPartMax_mps) << depth;
        EXPECT_LE(speed, before);
        before = speed;
    }
    EXPECT_EQ(before, 0) << "what hardly overlaps is let be";
}

// An overlap of 5 cm resolves: no tick moves the body faster than kPartMax_mps, and none moves it back.
TEST(Separating, ResolvesAnOverlapWithoutPopping) {
    float depth = 0.05f, slowest = 1;
    int ticks = 0;
    while (depth > kPartSlop_m + 1e-4f && ticks < 600) {
        const Contact c = against({0, 0, 1}, glm::vec3(0), depth);
        const float step = separating({&c, 1}).z / 120;
        EXPECT_GE(step, 0);
        EXPECT_LE(step, kPartMax_mps / 120);
        slowest = std::min(slowest, step);
        depth -= step;
        ++ticks;
    }
    EXPECT_LT(ticks, 120) << "within a second";
    EXPECT_GT(depth, 0);
}

} // namespace
} // namespace shoal::physics
