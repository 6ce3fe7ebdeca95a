// The shadow in closed form against rays to every part of the light.
#include "engine/render/CastShadow.h"
#include "tests/unit/shadow/ShadowScene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace shoal::render {
namespace {

using tests::kGround_m, tests::lightAt;

constexpr float kPi = std::numbers::pi_v<float>;

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

std::vector<FlatPiece> flat(const Ellipsoid& body, const CastingLight& light) {
    const occlusion::Ellipsoid shape{
        body.centre, glm::mat3(body.aside, glm::cross(body.along, body.aside), body.along), body.half};
    std::vector<FlatPiece> out;
    flatten({&shape, 1}, light, out);
    return out;
}

// Level ground around what bodies shade there.
struct Patch {
    glm::vec2 low{INFINITY}, high{-INFINITY};

    Patch(std::span<const FlatPiece> body, const CastingLight& light) {
        const float level = std::sqrt(1 - light.towards.y * light.towards.y);
        const float rise = light.towards.y - light.tangent * level; // of the disc's lower edge
        for (const FlatPiece& piece : body) {
            const float away = (piece.middle.y - kGround_m) / light.towards.y;
            const glm::vec3 under = piece.middle - away * light.towards;
            const float reach = (piece.halfAlong_m + piece.halfAside_m + 2 * light.tangent * away) / rise;
            low = glm::min(low, glm::vec2(under.x, under.z) - reach);
            high = glm::max(high, glm::vec2(under.x, under.z) + reach);
        }
    }
    glm::vec3 at(float u, float v) const {
        const glm::vec2 xz = glm::mix(low, high, glm::vec2(u, v));
        return {xz.x, kGround_m, xz.y};
    }
};

struct Difference {
    float maximum = 0, light = 0, rays = 0; // of what is hidden; over the ground, square metres
};

Difference compare(const Ellipsoid& body, const CastingLight& light) {
    const std::vector<FlatPiece> seen = flat(body, light);
    const Patch patch(seen, light);
    Difference all;
    constexpr int kSteps = 40;
    const glm::vec2 step = (patch.high - patch.low) / static_cast<float>(kSteps);
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x) {
            const glm::vec3 place = patch.at(static_cast<float>(x) / kSteps, static_cast<float>(y) / kSteps);
            const float form = covered(seen, light, place),
                        rays = tests::hiddenByRays(
                            light, 4000, [&](const glm::vec3&to) { return meets(body, place, to); });
            all.maximum = std::max(all.maximum, std::abs(form - rays));
            all.light += form * step.x * step.y;
            all.rays += rays * step.x * step.y;
        }
    return all;
}

// The light's disc is not a square, and a product of strips is not a rectangle's share of a disc. This error
// is largest for a sphere about as large as the light.
TEST(CastShadow, ASphereUnderACapShadesAsRaysFindIt) {
    for (const float radius_deg : {4.0f, 10.0f, 16.0f, 25.0f})
        for (const float elevation_deg : {90.0f, 66.0f}) {
            const Ellipsoid sphere{.half = glm::vec3(0.12f)};
            const Difference d = compare(sphere, lightAt(elevation_deg, radius_deg));
            EXPECT_LT(d.maximum, 0.16f) << radius_deg << " degrees wide, " << elevation_deg << " high";
            EXPECT_NEAR(d.light, d.rays, 0.06f * d.rays) << radius_deg << " degrees wide, " << elevation_deg;
        }
}

TEST(CastShadow, ASharkCastsAShadow) {
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

// A part behind another part of the same body hides nothing more, and parts that touch leave no gap.
TEST(CastShadow, PartsShadeAsTheirUnion) {
    const CastingLight light = lightAt(90, 10);
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

TEST(CastShadow, ALevelPlaneLosesNothingOfItsShare) {
    const CastingLight light = lightAt(66, 12);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.shareAt(light.towards.y)[c], light.share[c], 1e-6f);
    EXPECT_EQ(light.shareAt(0), glm::vec3(0));
    EXPECT_GT(light.shareAt(1).x, light.share.x);
}

// The share of a disc before a line is a polynomial: within 0.003 of what it stands for, and without a step.
TEST(CastShadow, TheShareOfADiscIsNearItsIntegral) {
    float before = 0;
    for (int i = -1100; i <= 1100; ++i) {
        const float t = static_cast<float>(i) / 1000, c = std::clamp(t, -1.0f, 1.0f);
        const float exact = 0.5f + (c * std::sqrt(1 - c * c) + std::asin(c)) / kPi;
        EXPECT_NEAR(discBefore(t), exact, 0.003f) << t;
        EXPECT_GE(discBefore(t), before - 1e-6f);
        before = discBefore(t);
    }
    EXPECT_EQ(discBefore(-2), discBefore(-1));
    EXPECT_NEAR(discBefore(-1), 0, 1e-6f);
    EXPECT_NEAR(discBefore(1), 1, 1e-6f);
}

} // namespace
} // namespace shoal::render
