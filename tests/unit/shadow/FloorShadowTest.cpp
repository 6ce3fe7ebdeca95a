// The shadow in closed form against rays to every part of the light.
#include "engine/render/FloorShadow.h"
#include "engine/render/ShadowPass.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace shoal::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kGround_m = -1.25f;

FloorLight lightAt(float elevation_deg, float radius_deg) {
    const float e = glm::radians(elevation_deg);
    return {.towards = {0.3f * std::cos(e), std::sin(e), std::sqrt(0.91f) * std::cos(e)},
            .tangent = std::tan(glm::radians(radius_deg)),
            .share = glm::vec3(0.4f, 0.35f, 0.3f),
            .height_m = kGround_m};
}

struct Ellipsoid {
    glm::vec3 centre{0}, along{0, 0, 1}, aside{1, 0, 0}; // unit
    glm::vec3 half{0.1f};                                // aside, up, along
};

bool meets(const Ellipsoid& body, const glm::vec3& from, const glm::vec3& dir) {
    const glm::mat3 turn(body.aside, glm::cross(body.along, body.aside), body.along);
    const glm::vec3 o = (glm::transpose(turn) * (from - body.centre)) / body.half;
    const glm::vec3 d = (glm::transpose(turn) * dir) / body.half;
    const float b = glm::dot(o, d), a = glm::dot(d, d), c = glm::dot(o, o) - 1;
    return b < 0 && b * b > a * c;
}

// The share of the cap's solid angle from which no ray gets through.
float hiddenByRays(const Ellipsoid& body, const FloorLight& light, const glm::vec2& xz) {
    constexpr int kRays = 4000;
    const glm::vec3 place(xz.x, light.height_m, xz.y);
    const glm::vec3 side = glm::normalize(glm::cross(light.towards, glm::vec3(0.1f, 0.2f, 0.9f)));
    const glm::vec3 up = glm::cross(side, light.towards);
    const float cosine = 1 / std::sqrt(1 + light.tangent * light.tangent);
    int hits = 0;
    for (int i = 0; i < kRays; ++i) {
        const float z = 1 - (1 - cosine) * (static_cast<float>(i) + 0.5f) / kRays;
        const float turn = static_cast<float>(i) * kPi * (3 - std::sqrt(5.0f)), ring = std::sqrt(1 - z * z);
        hits += meets(body, place, z * light.towards + ring * (std::cos(turn) * side + std::sin(turn) * up));
    }
    return static_cast<float>(hits) / kRays;
}

std::vector<FlatPiece> flat(const Ellipsoid& body, const FloorLight& light) {
    const occlusion::Ellipsoid shape{
        body.centre, glm::mat3(body.aside, glm::cross(body.along, body.aside), body.along), body.half};
    std::vector<FlatPiece> out;
    flatten({&shape, 1}, light, out);
    return out;
}

struct Difference {
    float maximum = 0, light = 0, rays = 0; // of what is hidden; over the ground, square metres
};

Difference compare(const Ellipsoid& body, const FloorLight& light) {
    const std::vector<FlatPiece> seen = flat(body, light);
    const FloorPatch patch = patchOf(seen, light, 0);
    Difference all;
    constexpr int kSteps = 24;
    const glm::vec2 step = (patch.high - patch.low) / static_cast<float>(kSteps);
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x) {
            const glm::vec2 xz = patch.low + step * glm::vec2(x, y);
            const float form = covered(seen, light, xz), rays = hiddenByRays(body, light, xz);
            all.maximum = std::max(all.maximum, std::abs(form - rays));
            all.light += form * step.x * step.y;
            all.rays += rays * step.x * step.y;
        }
    return all;
}

// A disc is no square, and the product of strips no rectangle's share of a disc: that is most for a sphere
// about as large as the light.
TEST(FloorShadow, OfASphereUnderACapAsRaysFindIt) {
    for (const float radius_deg : {4.0f, 10.0f, 16.0f, 25.0f})
        for (const float elevation_deg : {90.0f, 66.0f}) {
            const Ellipsoid sphere{.half = glm::vec3(0.12f)};
            const Difference d = compare(sphere, lightAt(elevation_deg, radius_deg));
            EXPECT_LT(d.maximum, 0.16f) << radius_deg << " degrees wide, " << elevation_deg << " high";
            EXPECT_NEAR(d.light, d.rays, 0.06f * d.rays) << radius_deg << " degrees wide, " << elevation_deg;
        }
}

TEST(FloorShadow, OfAShark) {
    for (const float radius_deg : {4.0f, 10.0f, 16.0f, 25.0f})
        for (const float elevation_deg : {90.0f, 66.0f}) {
            const Ellipsoid shark{.centre = {1, 0, -2},
                                  .along = glm::normalize(glm::vec3(0.8f, 0.2f, 0.5f)),
                                  .aside = glm::normalize(glm::vec3(0.5f, 0, -0.8f)),
                                  .half = {0.2f, 0.22f, 1.1f}};
            const Difference d = compare(shark, lightAt(elevation_deg, radius_deg));
            // The steps from slice to slice show where the light is narrow.
            EXPECT_LT(d.maximum, radius_deg < 5 ? 0.3f : 0.14f)
                << radius_deg << " degrees wide, " << elevation_deg << " high";
            EXPECT_NEAR(d.light, d.rays, 0.06f * d.rays) << radius_deg << " degrees wide, " << elevation_deg;
        }
}

// What lies behind another part of the same body hides nothing more, and parts that touch leave no gap.
TEST(FloorShadow, OfPartsIsThatOfTheirUnion) {
    const FloorLight light = lightAt(90, 10);
    const auto sphere = [](const glm::vec3& centre, float radius) {
        return occlusion::Ellipsoid{centre, glm::mat3(1), glm::vec3(radius)};
    };
    const auto taken = [&](const std::vector<occlusion::Ellipsoid>& body) {
        std::vector<FlatPiece> seen;
        flatten(body, light, seen);
        float area = 0;
        for (const FlatPiece& piece : seen) area += 4 * piece.halfAlong_m * piece.halfAside_m;
        return area;
    };
    const float one = taken({sphere({0, 0, 0}, 0.1f)});
    EXPECT_NEAR(one, kPi * 0.01f, 0.03f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0, 0.15f, 0}, 0.05f)}), one, 1e-3f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0.2f, 0, 0}, 0.1f)}), 2 * one, 0.1f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0.2f, 0, 0}, 0.1f), sphere({0, 0, 0.2f}, 0.1f)}),
                3 * one, 0.1f * one);
}

TEST(FloorShadow, NothingIsHiddenOutsideOfItsPatch) {
    const Ellipsoid shark{.centre = {1, 0.3f, -2}, .half = {0.2f, 0.22f, 1.1f}};
    for (const float radius_deg : {5.0f, 20.0f, 30.0f}) {
        const FloorLight light = lightAt(60, radius_deg);
        const auto seen = flat(shark, light);
        const FloorPatch patch = patchOf(seen, light, 0);
        ASSERT_GT(patch.across, 0);
        for (int i = 0; i <= 60; ++i) {
            const float t = static_cast<float>(i) / 60;
            const glm::vec2 at = glm::mix(patch.low, patch.high, t);
            for (const glm::vec2& edge : {glm::vec2(at.x, patch.low.y), glm::vec2(at.x, patch.high.y),
                                          glm::vec2(patch.low.x, at.y), glm::vec2(patch.high.x, at.y)})
                EXPECT_LT(covered(seen, light, edge), 1e-3f) << radius_deg << " degrees";
        }
    }
}

TEST(FloorShadow, WhereNothingCastsThereIsNoPatch) {
    const FloorLight light = lightAt(66, 16);
    const auto pieces = flat({.half = {0.02f, 0.02f, 0.06f}}, light);
    EXPECT_EQ(patchOf(pieces, light, 0.05f).across, 0) << "a small fish high above";
    const auto below = flat({.centre = {0, kGround_m - 1, 0}}, light);
    EXPECT_EQ(patchOf(below, light, 0).across, 0) << "below the ground";
    FloorLight dark = light;
    dark.share = glm::vec3(0);
    EXPECT_EQ(patchOf(pieces, dark, 0).across, 0) << "no light";
    EXPECT_EQ(patchOf({}, light, 0).across, 0);
    EXPECT_EQ(lightAt(10, 16).raised(), 0);
    EXPECT_EQ(lightAt(66, 16).raised(), 1);
}

// As a fish sinks its shadow comes in by less than a display value at a time.
TEST(FloorShadow, ComesInWithoutAStep) {
    const FloorLight light = lightAt(66, 16);
    float before = 0;
    bool came = false;
    for (int step = 0; step <= 1000; ++step) {
        const Ellipsoid fish{.centre = {0, 1 - 0.0021f * static_cast<float>(step), 0},
                             .half = {0.03f, 0.05f, 0.1f}};
        const auto pieces = flat(fish, light);
        const float away = (fish.centre.y - kGround_m) / light.towards.y;
        const glm::vec2 under(-light.towards.x * away, -light.towards.z * away);
        const float now = patchOf(pieces, light, 0.012f).strength * covered(pieces, light, under) * 0.4f;
        EXPECT_LT(std::abs(now - before), 1 / 255.0f);
        came |= now > 0.05f;
        before = now;
    }
    EXPECT_TRUE(came);
}

TEST(FloorShadow, LeavesNoMoreThanThereIs) {
    const FloorLight light = lightAt(66, 16);
    const water::Water clear{}, sea{.attenuation_perM = {0.2f, 0.1f, 0.08f}};
    for (const FrameCoding frames : {FrameCoding::Srgb, FrameCoding::Thesis})
        for (const float hidden : {0.0f, 0.3f, 1.0f})
            for (const float distance_m : {0.5f, 3.0f, 30.0f}) {
                const glm::vec3 left = leftOfGround(light, frames, hidden, sea, distance_m);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_LE(left[c], 1);
                    EXPECT_GE(left[c], 1 - hidden * light.share[c] - 1e-6f);
                }
            }
    // Half of 40 % of the light is hidden: 0.8 of it is left, and its square root as display values show it.
    EXPECT_NEAR(leftOfGround(light, FrameCoding::Thesis, 0.5f, clear, 3).x, 0.8f, 1e-6f);
    EXPECT_NEAR(leftOfGround(light, FrameCoding::Srgb, 0.5f, clear, 3).x, std::sqrt(0.8f), 1e-6f);
    EXPECT_NEAR(leftOfGround(light, FrameCoding::Srgb, 1, sea, 100).y, 1, 1e-3f); // all veil
}

} // namespace
} // namespace shoal::render
