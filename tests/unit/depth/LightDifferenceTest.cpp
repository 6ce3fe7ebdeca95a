#include "engine/depth/LightDifference.h"

#include "engine/math/LatLong.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::depth {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// An infinite matte white wall across +X, at this distance from the camera, with a lit disc.
struct Wall {
    float distance_m, litRadius_m;
    ImageRgbF radiance{64, 32};
    DepthMap map;

    Wall(float distance, float litRadius) : distance_m(distance), litRadius_m(litRadius) {
        map.inverse = Image<uint8_t, 1>(1024, 512);
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x < 1024; ++x)
                *map.inverse.at(x, y) = static_cast<uint8_t>(std::lround(std::clamp(
                    std::max(direction(x, y, 1024).x, 0.0f) / distance * DepthMap::kSteps * kNearest_m, 0.0f,
                    255.0f)));
        // Each texel is the mean of 16 x 16 looks, so that its edge is smooth.
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x < 1024; ++x) {
                const glm::vec3 dir = direction(x, y, 1024);
                const bool lit =
                    dir.x > 0 && glm::length(glm::vec2(dir.y, dir.z)) / dir.x * distance < litRadius;
                for (int c = 0; lit && c < 3; ++c) radiance.at(x / 16, y / 16)[c] += 1 / 256.0f;
            }
    }
    static glm::vec3 direction(int x, int y, int width) {
        return directionFromLatLong((glm::vec2(x, y) + 0.5f) / glm::vec2(width, width / 2));
    }
    // Over all directions, of a lit disc of radiance 1: its solid angle from its axis.
    float fluence(float away_m) const {
        return 2 * kPi * (1 - away_m / std::sqrt(away_m * away_m + litRadius_m * litRadius_m));
    }
};

constexpr float kY00 = 0.282095f;

TEST(LightDifference, NearASunlitWallThereIsMoreOfItsLight) {
    const Wall wall(1, 1);
    LightDifference light;
    light.make(wall.radiance, wall.map);
    for (const float towards_m : {-0.7f, 0.3f, 0.5f}) {
        const LightHarmonics beyond = light.at({towards_m, 0, 0});
        const float more = wall.fluence(1 - towards_m) - wall.fluence(1);
        // The disc's edge may be off by a quarter of a ray's width, sqrt(4 pi / 144).
        const float edge = 2 * kPi / std::hypot(1.0f, 1 - towards_m), off = 0.25f * std::sqrt(4 * kPi / 144);
        EXPECT_NEAR(beyond[0].x / kY00, more, edge * off) << towards_m;
        EXPECT_EQ(more > 0, beyond[3].x > 0) << "from +X";
        EXPECT_NEAR(beyond[1].x, 0, 0.1f) << "as much from above as from below";
        EXPECT_NEAR(beyond[2].x, 0, 0.1f);
    }
}

TEST(LightDifference, WhatIsFarGivesTheCamerasLight) {
    const Wall wall(LightDifference::kFar_m + 0.5f, 4);
    LightDifference light;
    light.make(wall.radiance, wall.map);
    for (const glm::vec3& harmonic : light.at({1, 0.5f, -1})) EXPECT_EQ(harmonic, glm::vec3(0));
}

TEST(LightDifference, AtTheCameraThereIsItsLight) {
    const Wall wall(1, 1);
    LightDifference light;
    light.make(wall.radiance, wall.map);
    for (const glm::vec3& harmonic : light.at(glm::vec3(0))) EXPECT_EQ(harmonic, glm::vec3(0));
}

} // namespace
} // namespace shoal::depth
