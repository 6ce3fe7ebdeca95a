// Fits to bodies made of ellipsoids return these ellipsoids.
#include "content/make/models/occlusion/Bvh.h"
#include "content/make/models/occlusion/FitEllipsoids.h"
#include "engine/math/LatLong.h"
#include "engine/occlusion/SmoothLight.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shoal::occlusion {
namespace {

struct Skin {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<uint16_t> joints;
    RestBody body() const { return {positions, indices, joints}; }
};

void addEllipsoid(Skin& skin, const glm::vec3& centre, const glm::vec3& semiAxes, uint16_t joint) {
    constexpr uint32_t kAround = 48, kDown = 24;
    const auto first = static_cast<uint32_t>(skin.positions.size());
    for (uint32_t y = 0; y <= kDown; ++y)
        for (uint32_t x = 0; x <= kAround; ++x) {
            skin.positions.push_back(
                centre + semiAxes * directionFromLatLong(glm::vec2(static_cast<float>(x) / kAround,
                                                                   static_cast<float>(y) / kDown)));
            skin.joints.push_back(joint);
        }
    for (uint32_t y = 0; y < kDown; ++y)
        for (uint32_t x = 0; x < kAround; ++x) {
            const uint32_t a = first + y * (kAround + 1) + x, b = a + kAround + 1;
            skin.indices.insert(skin.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
}

TEST(FitEllipsoids, GivesBackAnEllipsoid) {
    Skin skin;
    addEllipsoid(skin, {0.1f, -0.2f, 0.3f}, {0.2f, 0.1f, 0.4f}, 3);
    const auto parts = fitEllipsoids(skin.body(), Parts::ByShape, 1);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].joint, 3);
    EXPECT_LT(glm::distance(parts[0].atRest.centre, glm::vec3(0.1f, -0.2f, 0.3f)), 0.004f);
    std::vector<float> semi = {parts[0].atRest.semiAxes.x, parts[0].atRest.semiAxes.y,
                               parts[0].atRest.semiAxes.z};
    std::sort(semi.begin(), semi.end());
    // A fortieth of the length is a sample's size.
    EXPECT_NEAR(semi[0], 0.1f, 0.006f);
    EXPECT_NEAR(semi[1], 0.2f, 0.006f);
    EXPECT_NEAR(semi[2], 0.4f, 0.01f);
}

TEST(FitEllipsoids, GivesEachJointItsOwn) {
    Skin skin;
    addEllipsoid(skin, {0, 0, 0}, glm::vec3(0.1f), 5);
    addEllipsoid(skin, {0, 0, 0.3f}, glm::vec3(0.05f, 0.05f, 0.2f), 7);
    for (const Parts by : {Parts::ByJoint, Parts::ByShape}) {
        const auto parts = fitEllipsoids(skin.body(), by, 2);
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_NE(parts[0].joint, parts[1].joint);
        for (const BodyPart& part : parts)
            EXPECT_NEAR(part.atRest.centre.z, part.joint == 5 ? 0.0f : 0.3f, 0.03f);
    }
}

TEST(FitEllipsoids, MakesNothingOfNothing) {
    EXPECT_TRUE(fitEllipsoids({}, Parts::ByShape, 4).empty());
    const std::vector<glm::vec3> point(3, glm::vec3(1));
    const std::vector<uint32_t> indices = {0, 1, 2};
    const std::vector<uint16_t> joints(3, 0);
    EXPECT_TRUE(fitEllipsoids({point, indices, joints}, Parts::ByShape, 4).empty());
    // One triangle has no inside.
    const std::vector<glm::vec3> one = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const BodyPart& part : fitEllipsoids({one, indices, joints}, Parts::ByShape, 4))
        EXPECT_TRUE(std::isfinite(glm::dot(part.atRest.semiAxes, glm::vec3(1))));
}

TEST(Bvh, MeetsWhatEveryTriangleTriedInTurnMeets) {
    Skin skin;
    addEllipsoid(skin, {0, 0, 0}, {0.3f, 0.2f, 0.5f}, 0);
    addEllipsoid(skin, {0.4f, 0, 0}, {0.1f, 0.3f, 0.1f}, 0);
    const Bvh bvh(skin.positions, skin.indices);
    int met = 0;
    for (int i = 0; i < 500; ++i) {
        const auto k = static_cast<float>(i);
        const glm::vec3 origin(std::sin(k), std::cos(1.7f * k), 1.5f * std::sin(2.3f * k));
        const glm::vec3 direction = glm::normalize(glm::vec3(0.2f * std::sin(5 * k), 0.1f, 0.1f) - origin);
        float nearest = INFINITY;
        for (size_t t = 0; t < skin.indices.size(); t += 3) {
            const Bvh alone(skin.positions, std::span(skin.indices).subspan(t, 3));
            if (i % 50 == 0)
                if (const auto touch = alone.first(origin, direction, 0, INFINITY))
                    nearest = std::min(nearest, touch->distance);
        }
        const auto touch = bvh.first(origin, direction, 0, INFINITY);
        EXPECT_EQ(touch.has_value(), bvh.blocked(origin, direction, 0, INFINITY));
        met += touch.has_value();
        if (i % 50 == 0) {
            EXPECT_EQ(touch ? touch->distance : INFINITY, nearest);
        }
    }
    EXPECT_GT(met, 100);
    EXPECT_FALSE(Bvh({}, {}).first({}, {0, 0, 1}, 0, 1));
}

TEST(SmoothLight, FindsTheDominantLightAndKeepsTheMean) {
    ImageRgbF map(64, 32);
    const glm::vec3 dominant = glm::normalize(glm::vec3(0.3f, 0.8f, -0.4f));
    double mean = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 d = texelDirection(x, y, 64, 32);
            const float value = glm::dot(d, dominant) > 0.95f ? 20.0f : 1.0f;
            for (int c = 0; c < 3; ++c) map.at(x, y)[c] = value;
            mean += static_cast<double>(value) * texelSolidAngle(y, 64, 32) / (4 * std::numbers::pi);
        }
    const SmoothLight light = smoothLight(map);
    EXPECT_GT(glm::dot(light.dominantTowards, dominant), 0.999f);
    EXPECT_NEAR(light.dominantShare, 1 - 0.95f * 0.95f, 0.02f);
    const double dominantMean =
        static_cast<double>(light.dominantRadiance.x * (1 - std::sqrt(1 - light.dominantShare)) / 2);
    double around = 0;
    for (size_t k = 0; k < kAxisCount; ++k)
        around += static_cast<double>(light.ahead[k].x + light.behind[k].x) / (2 * kAxisCount);
    EXPECT_NEAR(around + dominantMean, mean, 0.01 * mean); // ends have not quite the same share of the sphere
    EXPECT_NEAR(static_cast<double>(light.even[0].x), mean, 1e-4 * mean);
}

TEST(SmoothLight, EvenLightHasNoDominantLight) {
    ImageRgbF map(64, 32);
    std::fill(map.pixels.begin(), map.pixels.end(), 2.0f);
    const SmoothLight light = smoothLight(map);
    for (size_t k = 0; k < kAxisCount; ++k) {
        EXPECT_NEAR(light.ahead[k].y, 2, 1e-4f);
        EXPECT_NEAR(light.behind[k].y, 2, 1e-4f);
    }
    EXPECT_NEAR(light.even[0].y, 2, 1e-4f);
    EXPECT_NEAR(light.even[2].y, 0, 1e-4f);
    EXPECT_EQ(light.dominantRadiance.y, 0);
}

} // namespace
} // namespace shoal::occlusion
