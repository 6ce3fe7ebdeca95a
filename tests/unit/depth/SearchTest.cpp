// The view of a film with distances from beside its camera, against geometry.
#include "engine/depth/DepthMap.h"
#include "tests/unit/depth/MadeMap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace shoal::depth {
namespace {

constexpr int kWidth = 1024;
// A step of the map's codes is 1 / (255 * 0.6) = 0.0065 / m, so a distance is half that off; an eye 0.3 m
// beside sees that by 0.001 rad. The search stops within 0.0015 rad.
constexpr float kOff_rad = 2.5e-3f;

const std::array<glm::vec3, 4> kEyes = {
    {{0.032f, 0, 0}, {-0.1f, 0.05f, 0.05f}, {0.3f, 0, 0}, {0, -0.2f, -0.2f}}};

float angleBetween(const glm::vec3& a, const glm::vec3& b) { return glm::length(glm::cross(a, b)); }

} // namespace

TEST(Search, MeetsAWallWhereItIs) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return std::max(-d.z, 0.0f) / 2; }); // z = -2
    for (const glm::vec3& eye : kEyes)
        for (float x = -1; x <= 1; x += 0.25f)
            for (float y = -0.5f; y <= 0.5f; y += 0.25f) {
                const glm::vec3 ray = glm::normalize(glm::vec3(x, y, -1));
                const glm::vec3 met = eye + ray * ((-2 - eye.z) / ray.z);
                const Seen seen = searchAlong(map, eye, ray);
                EXPECT_LT(angleBetween(seen.dirEnv, glm::normalize(met)), kOff_rad) << x << " " << y;
                EXPECT_NEAR(seen.inverse_perM, 1 / glm::length(met), 0.004f);
            }
}

// A rock covers columns 100 to 199 and rows 50 to 79 of a film of slopes. A ring of one texel around it
// becomes as near, also across the seam, and nothing else changes.
TEST(Search, NearThingsAreWidenedByATexel) {
    DepthMap map, widened;
    map.inverse = Image<uint8_t, 1>(1024, 512);
    const auto slope = [](int x, int y) { return static_cast<uint8_t>(10 + (x + y) % 8); };
    const auto isRock = [](int x, int y) {
        return (x >= 100 && x < 200 && y >= 50 && y < 80) || (x == 1023 && y == 300);
    };
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) *map.inverse.at(x, y) = isRock(x, y) ? 90 : slope(x, y);
    widenNear(map, widened);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) {
            const bool near = isRock(x, y) || isRock((x + 1) % 1024, y) || isRock((x + 1023) % 1024, y) ||
                              isRock(x, y - 1) || isRock(x, y + 1);
            ASSERT_EQ(*widened.inverse.at(x, y), near ? 90 : slope(x, y)) << x << " " << y;
        }
}

TEST(Search, MovesNothingThatIsEndlesslyFar) {
    const DepthMap map = mapOf([](const glm::vec3&) { return 0.0f; });
    for (const glm::vec3& eye : kEyes) {
        const glm::vec3 ray = glm::normalize(glm::vec3(0.4f, 0.2f, -1));
        EXPECT_LT(angleBetween(searchAlong(map, eye, ray).dirEnv, ray), 1e-5f);
    }
}

// A wall 1 m ahead that ends at x = 0, and nothing behind it: from the right the eye sees past its edge, and
// from there what the camera did not see is as empty as what it saw.
TEST(Search, SeesPastAnEdge) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return d.x < 0 ? std::max(-d.z, 0.0f) : 0.0f; });
    const glm::vec3 eye(0.1f, 0, 0);
    constexpr float kTexel = 2 * 3.1416f / kWidth;
    for (float x = -0.4f; x <= 0.3f; x += 0.01f) {
        if (std::abs(x + 0.1f) < 2 * kTexel) continue; // the edge itself
        const Seen seen = searchAlong(map, eye, glm::normalize(glm::vec3(x, 0, -1)));
        EXPECT_EQ(seen.inverse_perM > 0.5f, x < -0.1f) << x;
    }
}

// Seen from the left, the wall hides what the camera saw beside it.
TEST(Search, IsStoppedByAnEdgeThatComesBefore) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return d.x < 0 ? std::max(-d.z, 0.0f) : 0.1f; });
    const glm::vec3 eye(-0.1f, 0, 0);
    constexpr float kTexel = 2 * 3.1416f / kWidth;
    for (float x = -0.4f; x <= 0.4f; x += 0.01f) {
        if (std::abs(x - 0.1f) < 2 * kTexel) continue;
        const Seen seen = searchAlong(map, eye, glm::normalize(glm::vec3(x, 0, -1)));
        EXPECT_EQ(seen.inverse_perM > 0.5f, x < 0.1f) << x;
    }
}

TEST(Range, HoldsEveryTexelOfACap) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return 0.8f + 0.7f * d.x * d.y; });
    DepthRange range;
    range.make(map);
    for (const glm::vec3 middle :
         {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(0.6f, -0.8f, 0)})
        for (const float halfAngle : {0.02f, 0.3f, 1.2f}) {
            const DepthRange::Range found = range.around(middle, halfAngle);
            for (int y = 0; y < kWidth / 2; y += 3)
                for (int x = 0; x < kWidth; x += 3) {
                    const glm::vec2 uv((static_cast<float>(x) + 0.5f) / kWidth,
                                       (static_cast<float>(y) + 0.5f) / (kWidth / 2));
                    if (glm::dot(directionFromLatLong(uv), middle) < std::cos(halfAngle)) continue;
                    ASSERT_GE(DepthMap::perM(*map.inverse.at(x, y)), found.min_perM);
                    ASSERT_LE(DepthMap::perM(*map.inverse.at(x, y)), found.max_perM);
                }
        }
    // Not more than a cell around: the map changes by 0.7 of its sine a radian, a cell is 0.1 wide.
    const DepthRange::Range small = range.around({0, 0, -1}, 0.02f);
    EXPECT_LT(small.max_perM - small.min_perM, 0.7f * 2 * 0.13f * 0.13f + 0.01f);
}

} // namespace shoal::depth
