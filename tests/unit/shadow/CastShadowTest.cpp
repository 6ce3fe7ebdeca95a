// The shadow in closed form against rays to every part of the light.
#include "engine/render/CastShadow.h"
#include "engine/render/ShadowPass.h"
#include "tests/unit/shadow/ShadowScene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// The share of the cap's solid angle from which no ray gets through.
float hiddenByRays(const Ellipsoid& body, const CastingLight& light, const glm::vec3& place) {
    constexpr int kRays = 4000;
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
            const float form = covered(seen, light, place), rays = hiddenByRays(body, light, place);
            all.maximum = std::max(all.maximum, std::abs(form - rays));
            all.light += form * step.x * step.y;
            all.rays += rays * step.x * step.y;
        }
    return all;
}

// A disc is no square, and the product of strips no rectangle's share of a disc: that is most for a sphere
// about as large as the light.
TEST(CastShadow, OfASphereUnderACapAsRaysFindIt) {
    for (const float radius_deg : {4.0f, 10.0f, 16.0f, 25.0f})
        for (const float elevation_deg : {90.0f, 66.0f}) {
            const Ellipsoid sphere{.half = glm::vec3(0.12f)};
            const Difference d = compare(sphere, lightAt(elevation_deg, radius_deg));
            EXPECT_LT(d.maximum, 0.16f) << radius_deg << " degrees wide, " << elevation_deg << " high";
            EXPECT_NEAR(d.light, d.rays, 0.06f * d.rays) << radius_deg << " degrees wide, " << elevation_deg;
        }
}

TEST(CastShadow, OfAShark) {
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
TEST(CastShadow, OfPartsIsThatOfTheirUnion) {
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

// What a camera at the world's origin sees of a solid: its distance by direction.
template <class Distance> depth::DepthMap filmOf(const Distance& distance_m) {
    return depth::mapOf([&](const glm::vec3& dir) { return 1 / distance_m(dir); });
}

float toPlane(const glm::vec3& dir, const glm::vec3& normal, float distance_m) {
    const float towards = -glm::dot(dir, normal);
    return towards > 1e-4f ? distance_m / towards : INFINITY;
}

const Ellipsoid kShark{.centre = {0.3f, -0.4f, -1.6f}, .half = {0.2f, 0.22f, 1.1f}};

ShadowGrid castBy(const Ellipsoid& body, const CastingLight& light, const depth::DepthMap& map,
                  float minimum = 0.012f) {
    ShadowGrid grid;
    castOn({map}, flat(body, light), light, minimum, grid);
    return grid;
}

// Half a step of the map's 8 bits, at this distance from its camera.
float halfStep_m(float distance_m) { return 0.5f * distance_m * distance_m * depth::DepthMap::perM(1); }

// On planes, level and tilted, nodes lie where their distance says to within the map's half step, and take
// what the closed form gives for the place times the share that the plane's slope towards the light leaves.
TEST(CastShadow, OnPlanesIsTheClosedForm) {
    const CastingLight light = lightAt(66, 12);
    for (const glm::vec3& normal : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(0.5f, 1, 0.2f))}) {
        const auto map = filmOf([&](const glm::vec3& dir) { return toPlane(dir, normal, -kGround_m); });
        const ShadowGrid grid = castBy(kShark, light, map);
        ASSERT_GT(grid.across, 0);
        const auto pieces = flat(kShark, light);
        const glm::vec3 share = light.shareAt(glm::dot(normal, light.towards));
        float most = 0;
        double error = 0;
        for (const ShadowGrid::Node& node : grid.nodes) {
            ASSERT_GE(node.fall_m, 0);
            // Half a step along the look; bilinear rows of a plane that is seen at an angle add as much
            // again.
            ASSERT_NEAR(glm::dot(node.place, normal), kGround_m, 2 * halfStep_m(glm::length(node.place)));
            const float expected = covered(pieces, light, node.place) * share.x;
            error += static_cast<double>(std::abs(node.taken.x - expected));
            most = std::max(most, node.taken.x);
        }
        EXPECT_GT(most, 0.2f);
        // Steps of the map tilt the normal, over a quarter of a metre, by 0.05 on average: a few hundredths
        // of the share, of which a body takes half at most places.
        EXPECT_LT(error / static_cast<double>(grid.nodes.size()), 0.01);
    }
}

TEST(CastShadow, OfALevelPlaneLosesNothingOfItsShare) {
    const CastingLight light = lightAt(66, 12);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.shareAt(light.towards.y)[c], light.share[c], 1e-6f);
    EXPECT_EQ(light.shareAt(0), glm::vec3(0));
    EXPECT_GT(light.shareAt(1).x, light.share.x);
}

TEST(CastShadow, NothingIsHiddenBeyondTheGrid) {
    const auto map = tests::levelGround();
    for (const float radius_deg : {5.0f, 20.0f, 30.0f}) {
        const ShadowGrid grid = castBy(kShark, lightAt(60, radius_deg), map, 0);
        ASSERT_GT(grid.across, 0);
        for (int y = 0; y <= grid.down; ++y)
            for (int x = 0; x <= grid.across; ++x)
                if (x == 0 || y == 0 || x == grid.across || y == grid.down) {
                    const auto& node = grid.nodes[static_cast<size_t>(y * (grid.across + 1) + x)];
                    EXPECT_LT(node.taken.x, 1e-3f) << radius_deg << " degrees";
                }
    }
}

// Ground 1 m below the camera ends 1.6 m ahead of it; beyond it lies 0.4 m lower. The camera sees nothing of
// what is just behind the edge. Every node lies on one of the two, and no triangle spans them.
TEST(CastShadow, OverAStepNoTriangleSpansIt) {
    const auto distance = [](const glm::vec3& dir) {
        const float near_m = toPlane(dir, {0, 1, 0}, 1), far_m = toPlane(dir, {0, 1, 0}, 1.4f);
        return near_m * -dir.z < 1.6f ? near_m : far_m;
    };
    const ShadowGrid grid = castBy(kShark, lightAt(90, 8), filmOf(distance));
    ASSERT_GT(grid.across, 0);
    int onNear = 0, onFar = 0, spanning = 0;
    for (const auto& node : grid.nodes) {
        if (node.fall_m < 0) continue;
        onNear += std::abs(node.place.y + 1) < 0.1f, onFar += std::abs(node.place.y + 1.4f) < 0.1f;
    }
    const size_t stride = static_cast<size_t>(grid.across) + 1;
    for (size_t a = 0; a + stride + 1 < grid.nodes.size(); ++a)
        if ((a + 1) % stride != 0 && grid.shades(a, a + 1, a + stride)) {
            const auto [low, high] = std::minmax(
                {grid.nodes[a].place.y, grid.nodes[a + 1].place.y, grid.nodes[a + stride].place.y});
            spanning += high - low > 0.3f;
        }
    EXPECT_GT(onNear, 20);
    EXPECT_GT(onFar, 20);
    EXPECT_EQ(spanning, 0);
}

TEST(CastShadow, BendsOverASphere) {
    const glm::vec3 centre(0.3f, -1.8f, -1.8f);
    constexpr float kRadius_m = 1;
    const auto distance = [&](const glm::vec3& dir) {
        const float b = glm::dot(dir, centre), c = glm::dot(centre, centre) - kRadius_m * kRadius_m;
        return b > 0 && b * b > c ? b - std::sqrt(b * b - c) : INFINITY;
    };
    const ShadowGrid grid = castBy({.centre = {0.3f, -0.4f, -1.5f}}, lightAt(90, 8), filmOf(distance));
    ASSERT_GT(grid.across, 0);
    int shaded = 0;
    for (const auto& node : grid.nodes)
        if (node.fall_m >= 0 && node.taken.x > 0.02f) {
            EXPECT_NEAR(glm::distance(node.place, centre), kRadius_m, 0.05f);
            ++shaded;
        }
    EXPECT_GT(shaded, 10);
}

TEST(CastShadow, WhereNothingCastsThereIsNoGrid) {
    const CastingLight light = lightAt(66, 16);
    const auto ground = tests::levelGround();
    const auto unknown = filmOf([](const glm::vec3&) { return INFINITY; });
    EXPECT_EQ(castBy({.half = {0.02f, 0.02f, 0.06f}}, light, ground, 0.05f).across, 0) << "a small fish";
    EXPECT_EQ(castBy(kShark, light, unknown, 0).across, 0) << "distances that nobody knows";
    EXPECT_EQ(castBy({.centre = {0, kGround_m - 1, 0}}, light, ground, 0).across, 0) << "below the ground";
    CastingLight dark = light;
    dark.share = glm::vec3(0);
    EXPECT_EQ(castBy(kShark, dark, ground, 0).across, 0) << "no light";
    ShadowGrid none;
    castOn({ground}, {}, light, 0, none);
    EXPECT_EQ(none.across, 0);
    EXPECT_EQ(lightAt(10, 16).raised(), 0);
    EXPECT_EQ(lightAt(66, 16).raised(), 1);
}

// What is taken at a place of level ground, linear within the grid's triangles as it is drawn.
float drawnAt(const ShadowGrid& grid, const glm::vec2& place) {
    const size_t stride = static_cast<size_t>(grid.across) + 1;
    const auto within = [&](size_t a, size_t b, size_t c) {
        if (!grid.shades(a, b, c)) return 0.0f;
        const auto at = [&](size_t i) { return glm::vec2(grid.nodes[i].place.x, grid.nodes[i].place.z); };
        const glm::mat2 edges(at(b) - at(a), at(c) - at(a));
        const glm::vec2 share = glm::inverse(edges) * (place - at(a));
        if (share.x < 0 || share.y < 0 || share.x + share.y > 1) return 0.0f;
        const auto taken = [&](size_t i) { return grid.nodes[i].taken.x; };
        return taken(a) + share.x * (taken(b) - taken(a)) + share.y * (taken(c) - taken(a));
    };
    float found = 0;
    for (size_t a = 0; a + stride + 1 < grid.nodes.size(); ++a)
        if ((a + 1) % stride != 0)
            found =
                std::max({found, within(a, a + 1, a + stride), within(a + stride, a + 1, a + stride + 1)});
    return found;
}

struct Steps {
    float comingIn = 0, ever = 0,
          most = 0; // largest change while little is taken, at all; most that is taken
};

// What is taken in the middle of a body's shadow as the body sinks, in a thousand steps.
Steps stepsOfSinking(const glm::vec3& half, float ground_m, float from_m, float to_m) {
    const CastingLight light = lightAt(66, 16);
    const auto ground = tests::levelGround(ground_m);
    Steps steps;
    float before = 0;
    for (int step = 0; step <= 1000; ++step) {
        const float height = from_m + (to_m - from_m) * static_cast<float>(step) / 1000;
        const Ellipsoid body{.centre = {0, height, -1}, .half = half};
        const glm::vec3 under = body.centre - light.towards * ((height - ground_m) / light.towards.y);
        const float now = drawnAt(castBy(body, light, ground), {under.x, under.z});
        steps.ever = std::max(steps.ever, std::abs(now - before));
        if (before < 0.05f) steps.comingIn = steps.ever;
        steps.most = std::max(steps.most, now);
        before = now;
    }
    return steps;
}

// As a fish sinks its shadow comes in by less than a display value at a time; so does a shark's that comes
// within the reach of shadows, 8 m. Where a shadow is seen, a grid that has one cell more or less may change
// it by two display values: these are about square roots, and change half as much as the light.
TEST(CastShadow, ComesInWithoutAStep) {
    const glm::vec3 fish(0.03f, 0.05f, 0.1f), shark(0.2f, 0.22f, 1.1f);
    for (const Steps& steps : {stepsOfSinking(fish, kGround_m, 1, -1.1f), stepsOfSinking(shark, -6, 2, -2)}) {
        EXPECT_LT(steps.comingIn, 1 / 255.0f);
        EXPECT_LT(steps.ever, 0.02f);
        EXPECT_GT(steps.most, 0.05f);
    }
}

// Eyes all around, each of which looks past bodies all around: whoever sees a lit corner of a shadow is not
// told that there is nothing to see, and most of those that see none are.
TEST(CastShadow, WhereItFallsIsSoughtIfAnEyeMaySeeIt) {
    const auto ground = tests::levelGround();
    const CastingLight light = lightAt(66, 16);
    int seen = 0, passedOver = 0, unseen = 0;
    for (int k = 0; k < 12; ++k) {
        const float turn = static_cast<float>(k) * kPi / 6;
        const Ellipsoid body{.centre = {2 * std::cos(turn), -0.2f, 2 * std::sin(turn)},
                             .half = {0.1f, 0.1f, k % 3 == 0 ? 0.9f : 0.2f}};
        const std::vector<FlatPiece> pieces = flat(body, light);
        const ShadowGrid grid = castBy(body, light, ground);
        for (int yaw = 0; yaw < 24; ++yaw)
            for (const float pitch : {-0.9f, 0.0f, 0.5f}) {
                const View eye{.eyeWorld = {0.3f, 0.1f, -0.2f},
                               .worldFromEye =
                                   glm::angleAxis(static_cast<float>(yaw) * kPi / 12, glm::vec3(0, 1, 0)) *
                                   glm::angleAxis(pitch, glm::vec3(1, 0, 0)),
                               .verticalFov = 0.6f,
                               .shift = {0.1f, -0.05f}};
                const bool sees = std::ranges::any_of(grid.nodes, [&](const ShadowGrid::Node& node) {
                    if (node.fall_m < 0 || node.taken == glm::vec3(0)) return false;
                    const glm::vec4 clip = eye.clipFromWorld() * glm::vec4(node.place, 1);
                    return clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
                });
                const bool told = mayBeSeen(pieces, light, eye);
                EXPECT_TRUE(told || !sees) << k << ", " << yaw << ", " << pitch;
                seen += sees, unseen += !sees, passedOver += !told;
            }
    }
    EXPECT_GT(seen, 50);
    EXPECT_GT(passedOver, unseen / 2);
}

TEST(CastShadow, LeavesNoMoreThanThereIs) {
    const CastingLight light = lightAt(66, 16);
    const water::Water clear{}, sea{.attenuation_perM = {0.2f, 0.1f, 0.08f}};
    for (const FrameCoding frames : {FrameCoding::Srgb, FrameCoding::Thesis})
        for (const float hidden : {0.0f, 0.3f, 1.0f})
            for (const float distance_m : {0.5f, 3.0f, 30.0f}) {
                const glm::vec3 left = leftOf(hidden * light.share, frames, sea, distance_m);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_LE(left[c], 1);
                    EXPECT_GE(left[c], 1 - hidden * light.share[c] - 1e-6f);
                }
            }
    // Half of 40 % of the light is hidden: 0.8 of it is left, and its square root as display values show it.
    EXPECT_NEAR(leftOf(0.5f * light.share, FrameCoding::Thesis, clear, 3).x, 0.8f, 1e-6f);
    EXPECT_NEAR(leftOf(0.5f * light.share, FrameCoding::Srgb, clear, 3).x, std::sqrt(0.8f), 1e-6f);
    EXPECT_NEAR(leftOf(1.0f * light.share, FrameCoding::Srgb, sea, 100).y, 1, 1e-3f); // all veil
}

} // namespace
} // namespace shoal::render
