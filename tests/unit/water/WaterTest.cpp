// The effect of water on an object's light, and its change with time.
#include "engine/water/EstimateWater.h"

#include "tests/unit/water/SeenThrough.h"

#include <gtest/gtest.h>

namespace shoal::water {
namespace {

Water evenWater() {
    Water water;
    water.veil[0] = {0.04f, 0.25f, 0.49f}; // squared
    water.attenuation_perM = {0.2f, 0.1f, 0.08f};
    return water;
}

TEST(Water, NothingBetweenChangesNothingAndEndlessWaterIsAllVeil) {
    const glm::vec3 display(0.5f, 0.9f, 0.1f), dir(0, 0, -1);
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(seenThrough({}, display, dir, 100)[c], display[c]);
    EXPECT_TRUE(Water{}.none());
    const glm::vec3 near = seenThrough(evenWater(), display, dir, 0),
                    far = seenThrough(evenWater(), display, dir, 1000);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(near[c], display[c], 1e-6f);
        EXPECT_NEAR(far[c], std::sqrt(evenWater().veil[0][c]), 1e-6f);
    }
}

// Light is about the square of display values: white at ln 2 / beta is half white, half veil.
TEST(Water, HalfTheLightIsLeftAtHalfTheDistance) {
    const glm::vec3 seen = seenThrough(evenWater(), glm::vec3(1), {0, 1, 0}, std::log(2.0f) / 0.1f);
    EXPECT_NEAR(seen.y * seen.y, 0.5f * 1 + 0.5f * 0.25f, 1e-5f);
}

TEST(Water, AVeilIsNeverDarkerThanNothing) {
    Water water = evenWater();
    water.veil[2] = {-1, -1, -1}; // falls below zero straight up
    EXPECT_EQ(veilTowards(water, {0, 1, 0}), glm::vec3(0));
}

WaterEstimate estimateOf(const glm::vec3& veil, float attenuation_perM) {
    WaterEstimate estimate;
    estimate.water.veil[0] = veil;
    estimate.water.attenuation_perM = glm::vec3(attenuation_perM);
    estimate.evidence = 1;
    return estimate;
}

TEST(WaterOverTime, IsThereAtOnceAndStaysAsItIs) {
    const WaterEstimate estimate = estimateOf({0.1f, 0.2f, 0.3f}, 0.12f);
    WaterOverTime water;
    for (int i = 0; i < 1000; ++i) {
        water.follow(estimate, 1, 1 / 60.0f);
        ASSERT_EQ(water.water().veil[0], estimate.water.veil[0]);
        ASSERT_NEAR(water.water().attenuation_perM.y, 0.12f, 1e-6f);
    }
}

TEST(WaterOverTime, ACutIsFollowedWithinASecondWithoutAStep) {
    WaterOverTime water;
    water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 1, 0);
    const WaterEstimate after = estimateOf(glm::vec3(1.1f), 0.4f);
    float before = 0.1f;
    for (int i = 0; i < 60; ++i) {
        water.follow(after, 1, 1 / 60.0f);
        const float now = water.water().veil[0].x;
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, 0.05f); // of the change of 1: no step that an eye takes for a flash
        before = now;
    }
    EXPECT_NEAR(before, 1.0f, 0.01f);                   // nine tenths of the way
    EXPECT_LT(water.water().attenuation_perM.x, 0.25f); // slower
    for (int i = 0; i < 1500; ++i) water.follow(after, 1, 1 / 60.0f);
    EXPECT_NEAR(water.water().attenuation_perM.x, 0.4f, 0.01f);
}

TEST(WaterOverTime, DoesNotDependOnHowOftenPicturesAreDrawn) {
    const auto end = [](int pictures) {
        WaterOverTime water;
        water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 1, 0);
        for (int i = 0; i < pictures; ++i)
            water.follow(estimateOf(glm::vec3(1), 0.4f), 0.5f, 1.0f / static_cast<float>(pictures));
        return water.water();
    };
    EXPECT_NEAR(end(24).veil[0].x, end(240).veil[0].x, 1e-4f);
    EXPECT_NEAR(end(24).attenuation_perM.x, end(240).attenuation_perM.x, 1e-4f);
}

TEST(WaterOverTime, NoStrengthIsNoWater) {
    WaterOverTime water;
    EXPECT_TRUE(water.water().none()); // before anything was seen
    water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 0, 0);
    EXPECT_TRUE(water.water().none());
}

} // namespace
} // namespace shoal::water
