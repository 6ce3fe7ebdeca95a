// Occlusion by ellipsoids where it is known in closed form.
#include "tests/baselines/occlusion/OccludeByEllipsoids.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::occlusion {
namespace {

const glm::vec3 kSlants[] = {{0, 1, 0}, {0.6f, 0.8f, 0}, {0.3f, -0.5f, 0.81f}, {-0.7f, 0.1f, -0.7f}};

Occluder sphereAt(const glm::vec3& centre, float radius) {
    return {{centre, glm::mat3(1), glm::vec3(radius)}, 1, {}};
}

float shareOf(const glm::vec3& normal, std::span<const Occluder> occluders) {
    return occlusionMoments(axisOcclusion({}, normal, occluders), normal).w;
}

// Tests the largest angle between a direction and the nearest end, and how evenly cosines add up.
TEST(Axes, AreSpreadEvenly) {
    for (int i = 0; i < 500; ++i) {
        const auto k = static_cast<float>(i);
        const glm::vec3 d =
            glm::normalize(glm::vec3(std::sin(k), std::cos(1.7f * k), std::sin(2.3f * k + 1)));
        float nearest = 0, sum = 0;
        for (const glm::vec3& axis : kAxes) {
            nearest = std::max(nearest, std::abs(glm::dot(axis, d)));
            sum += std::abs(glm::dot(axis, d)) * 2 / kAxisCount;
        }
        EXPECT_GT(nearest, 0.93f) << i;
        EXPECT_NEAR(sum, 1, 0.025f) << i;
    }
}

// Straight ahead a sphere takes sin^2 of its half angle. Few axes see it now larger, now smaller: within a
// twentieth of the hemisphere each, and less on the mean.
TEST(Ellipsoid, ASphereAheadTakesTheSquareOfItsSine) {
    for (const float sine : {0.3f, 0.5f, 0.7f, 0.9f}) {
        float mean = 0;
        for (const glm::vec3& normal : kSlants) {
            const glm::vec3 n = glm::normalize(normal);
            const Occluder sphere = sphereAt(n, sine);
            const float share = shareOf(n, {&sphere, 1});
            EXPECT_NEAR(share, sine * sine, 0.05f) << sine;
            mean += share / 4;
        }
        EXPECT_NEAR(mean, sine * sine, 0.04f) << sine;
    }
}

// Seen from its skin it is a half space: facing it nothing is left, looking away hardly anything is taken,
// and looking along it half.
TEST(Ellipsoid, IsAHalfSpaceFromItsSkinAndWithin) {
    const glm::mat3 turn = glm::mat3_cast(glm::normalize(glm::quat(0.6f, 0.3f, -0.5f, 0.2f)));
    for (const float depth : {0.0f, 0.01f, 0.1f}) {
        const Occluder body = {{turn * glm::vec3(-0.2f + depth, 0, 0), turn, {0.2f, 0.3f, 0.5f}}, 1, {}};
        EXPECT_GT(shareOf(turn * glm::vec3(-1, 0, 0), {&body, 1}), 0.96f);
        EXPECT_LT(shareOf(turn * glm::vec3(1, 0, 0), {&body, 1}), 0.04f);
        EXPECT_NEAR(shareOf(turn * glm::vec3(0, 1, 0), {&body, 1}), 0.5f, 0.06f);
    }
    const Occluder around = {{{}, glm::mat3(1), glm::vec3(1)}, 1, {}}; // from its very middle
    EXPECT_TRUE(std::isfinite(shareOf({0, 1, 0}, {&around, 1})));
}

TEST(Ellipsoid, NoSizeFarAwayOrBehindTakesNothing) {
    const Occluder none[] = {sphereAt({0, 1, 0}, 1e-4f),
                             sphereAt({0, 300, 0}, 0.1f),
                             sphereAt({0, -2, 0}, 1),
                             {{{0, 1, 0}, glm::mat3(1), glm::vec3(0.5f)}, 0, {}}};
    for (const Occluder& each : none) EXPECT_LT(shareOf({0, 1, 0}, {&each, 1}), 1e-3f);
}

// Scene and surface turned together: the axes do not turn with them.
TEST(Ellipsoid, TakesMuchTheSameWhicheverWayTheSceneIsTurned) {
    float minimum = 1, maximum = 0;
    for (int i = 0; i < 40; ++i) {
        const auto k = static_cast<float>(i);
        const glm::mat3 turn = glm::mat3_cast(
            glm::normalize(glm::quat(std::sin(k), std::cos(2 * k), std::sin(3 * k), std::cos(5 * k))));
        const Occluder body = {{turn * glm::vec3(0.3f, 0.6f, -0.2f), turn, {0.15f, 0.4f, 0.6f}}, 1, {}};
        const float share = shareOf(turn * glm::vec3(0, 1, 0), {&body, 1});
        minimum = std::min(minimum, share), maximum = std::max(maximum, share);
    }
    EXPECT_LT(maximum - minimum, 0.06f);
    EXPECT_GT(minimum, 0.15f);
}

TEST(Take, NothingTakesExactlyNothing) {
    SmoothLight light;
    light.ahead.fill({1, 2, 3});
    light.behind.fill({3, 2, 1});
    light.dominantRadiance = glm::vec3(50);
    const OcclusionResult taken = occlude({}, {0, 1, 0}, {}, {}, {}, light);
    EXPECT_EQ(taken.share, 0);
    EXPECT_EQ(taken.radiance, glm::vec3(0));
}

// In a white furnace, bodies reflect as much light as they take.
TEST(Take, WhiteBodiesInEvenLightTakeLittle) {
    SmoothLight light;
    light.ahead.fill(glm::vec3(1));
    light.behind.fill(glm::vec3(1));
    light.even[0] = glm::vec3(1);
    Occluder black = sphereAt({0, 1.5f, 0}, 0.6f), white = black;
    white.albedo = glm::vec3(1);
    const OcclusionResult dark = occlude({}, {0, 1, 0}, {}, {}, {&black, 1}, light),
                          lit = occlude({}, {0, 1, 0}, {}, {}, {&white, 1}, light);
    EXPECT_NEAR(dark.radiance.x, dark.share, 0.03f * dark.share);
    EXPECT_NEAR(lit.radiance.x, dark.share * dark.share, 0.03f * dark.share); // white in each other's shade
}

// A dominant light is fully hidden behind a sphere, fully visible beside it, and fades in between.
TEST(Take, ADominantLightRunsFromAllToNoneAcrossTheEdge) {
    SmoothLight light;
    light.dominantShare = 0.02f;
    light.dominantRadiance = glm::vec3(1 / light.dominantShare);
    float before = 2;
    for (float angle = 0; angle < 0.8f; angle += 0.02f) {
        light.dominantTowards = {std::sin(angle), std::cos(angle), 0};
        const Occluder sphere = sphereAt({0, 2, 0}, 0.8f); // half angle 0.41
        const float hidden = occlude({}, {0, 1, 0}, {}, {}, {&sphere, 1}, light).radiance.x / std::cos(angle);
        EXPECT_LE(hidden, before + 0.02f) << angle;
        if (angle < 0.2f) {
            EXPECT_NEAR(hidden, 1, 0.02f) << angle;
        }
        if (std::abs(angle - 0.41f) < 0.011f) {
            EXPECT_NEAR(hidden, 0.5f, 0.12f);
        }
        if (angle > 0.66f) {
            EXPECT_NEAR(hidden, 0, 0.01f) << angle;
        }
        before = hidden;
    }
}

// A body's skin is now outside, now within its own ellipsoids.
TEST(OpenLobe, IsWholeWhereItLooksOutOfASkin) {
    const Occluder body = {{{}, glm::mat3(1), {0.2f, 0.3f, 0.5f}}, 1, {}};
    for (const float depth : {-0.02f, 0.0f, 0.02f}) {
        EXPECT_EQ(lobeVisibility({0.2f - depth, 0, 0}, {1, 0, 0}, 0.4f, {&body, 1}), 1) << depth;
        EXPECT_LT(lobeVisibility({0.2f - depth, 0, 0}, {-1, 0, 0}, 0.4f, {&body, 1}), 0.01f) << depth;
    }
}

} // namespace
} // namespace shoal::occlusion
