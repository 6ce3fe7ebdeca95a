// What is built on rays: mirrors, shadows in diffuse light, many bodies.
#include "Bodies.h"
#include "tests/baselines/occlusion/DiffuseShadow.h"
#include "tests/baselines/occlusion/Mirror.h"
#include "tests/baselines/occlusion/PlacedBodies.h"
#include "tests/baselines/occlusion/TracedOllfb.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace shoal::occlusion {
namespace {

// A sphere around the origin, exactly.
struct ExactSphere {
    float radius = 1;
    std::optional<Hit> trace(const glm::vec3& o, const glm::vec3& d, float nearest) const {
        const float b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius;
        if (b * b < c) return {};
        const float t = -b - std::sqrt(b * b - c);
        if (t <= nearest) return {};
        return Hit{t, (o + t * d) / radius};
    }
};

// The planes y = 0 and y = 1, mirrors that face each other.
struct Corridor {
    std::optional<Hit> trace(const glm::vec3& o, const glm::vec3& d, float) const {
        if (d.y == 0) return {};
        const bool up = d.y > 0;
        return Hit{((up ? 1.0f : 0.0f) - o.y) / d.y, {0, up ? -1 : 1, 0}};
    }
};

TEST(Mirror, BouncesAsOftenAsAllowed) {
    const glm::vec3 direction = glm::normalize(glm::vec3(3, 4, 0));
    for (const int maximum : {0, 1, 2, 8}) {
        const Reflected end = followMirrors(Corridor{}, {0, 0.5f, 0}, direction, 1e-3f, maximum);
        EXPECT_EQ(end.bounces, maximum);
        EXPECT_TRUE(end.caught);
        // Every bounce turns y; the way to the nth is n - 1/2 high, three quarters of that long.
        EXPECT_NEAR(end.direction.y, maximum % 2 ? -0.8f : 0.8f, 1e-6f);
        if (maximum) {
            EXPECT_NEAR(end.origin.x, 0.75f * (static_cast<float>(maximum) - 0.5f), 1e-5f);
        }
    }
    const Reflected free = followMirrors(ExactSphere{}, {0, 0, 3}, {0, 1, 0}, 0, 8);
    EXPECT_EQ(free.bounces, 0);
    EXPECT_FALSE(free.caught);
}

TEST(Mirror, CuredLayersBounceAsTruthDoes) {
    const Body body = torus(1, 0.4f, 96, 48);
    const TracedOllfb cured = TracedOllfb::make(body.mesh()).value();
    struct Exact {
        const Body& body;
        std::optional<Hit> trace(const glm::vec3& o, const glm::vec3& d, float nearest) const {
            const auto hit = truth(body, o, d, static_cast<double>(nearest));
            if (!hit) return {};
            return Hit{static_cast<float>(hit->distance), hit->normal};
        }
    };
    // Into the ring from above: off the inner walls, once or more.
    Random random(8);
    int twice = 0, same = 0, all = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 from(random.between(-0.2f, 0.2f), 2, random.between(-0.2f, 0.2f));
        const glm::vec3 to(random.between(-0.8f, 0.8f), 0, random.between(-0.8f, 0.8f));
        const glm::vec3 d = glm::normalize(to - from);
        const Reflected exact = followMirrors(Exact{body}, from, d, 0.02f, 8);
        const Reflected ours = followMirrors(cured, from, d, 0.02f, 8);
        ++all, same += exact.bounces == ours.bounces, twice += exact.bounces >= 2;
    }
    std::printf("%d of %d with two bounces or more; %d as often as in truth\n", twice, all, same);
    EXPECT_GT(twice, 20);
    EXPECT_GE(same, all * 95 / 100);
}

TEST(DiffuseShadow, OfASphereIsItsFormFactor) {
    const ShadowRays rays(2048);
    // Hidden by a sphere straight above, of angular radius s: sin^2 s. (Howell, "A catalog of radiation heat
    // transfer configuration factors", B-12.)
    for (const float height : {1.2f, 1.5f, 2.0f, 4.0f}) {
        const float visible = rays.visibility(ExactSphere{}, {0, -height, 0}, {0, 1, 0}, 0);
        EXPECT_NEAR(visible, 1 - 1 / (height * height), 0.01f) << height;
    }
    EXPECT_EQ(rays.visibility(ExactSphere{}, {0, -2, 0}, {0, -1, 0}, 0), 1);
    // Light only from straight above, in a narrow cone: gone.
    const auto dominant = [](const glm::vec3& d) { return glm::vec3(d.y > 0.95f ? 1.0f : 0.0f); };
    EXPECT_EQ(rays.gather(ExactSphere{}, {0, -2, 0}, {0, 1, 0}, 0, dominant), glm::vec3(0));
    EXPECT_NEAR(rays.gather(ExactSphere{}, {5, -2, 0}, {0, 1, 0}, 0, dominant).x, 1 - 0.95f * 0.95f, 0.01f);
}

TEST(DiffuseShadow, OfCuredLayersIsSmooth) {
    const Body body = sphere(1);
    const TracedOllfb cured = TracedOllfb::make(body.mesh(), {.views = 54}).value();
    const ShadowRays rays(1024);
    float before = -1;
    for (int i = 0; i <= 100; ++i) {
        const glm::vec3 place(-3 + 0.06f * static_cast<float>(i), -1.5f, 0);
        const float visible = rays.visibility(cured, place, {0, 1, 0}, 0);
        EXPECT_NEAR(visible, rays.visibility(ExactSphere{}, place, {0, 1, 0}, 0), 0.01f) << i;
        // A step of 0.06 changes the form factor by at most 0.04; two rays of 512 more.
        if (before >= 0) {
            EXPECT_NEAR(visible, before, 0.04f + 0.005f) << i;
        }
        before = visible;
    }
}

TEST(Bodies, AreMetInTheirOwnFramesNearestFirst) {
    const ExactSphere sphere;
    Bodies<ExactSphere> bodies;
    const auto put = [&](const glm::vec3& at, float scale) {
        glm::mat4 worldFromBody = glm::translate(glm::mat4(1), at);
        worldFromBody = glm::rotate(worldFromBody, 1.0f, glm::normalize(glm::vec3(1, 2, 3)));
        bodies.placed.push_back(place(sphere, {{0, 0, 0}, 1}, glm::scale(worldFromBody, glm::vec3(scale))));
    };
    put({0, 0, -20}, 2);
    put({0, 0, -10}, 0.5f);
    put({5, 0, -10}, 1);
    const auto hit = bodies.trace({0, 0, 0}, {0, 0, -1}, 0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 9.5f, 1e-4f);
    EXPECT_NEAR(glm::distance(hit->normal, glm::vec3(0, 0, 1)), 0, 1e-4f);
    const auto behind = bodies.trace({0, 0, 0}, {0, 0, -1}, 9.6f);
    ASSERT_TRUE(behind);
    EXPECT_NEAR(behind->distance, 18, 1e-3f);
    EXPECT_FALSE(bodies.trace({0, 0, 0}, {0, 1, 0}, 0));
    EXPECT_FALSE(bodies.trace({0, 0, 0}, {0, 0, 1}, 0));
}

TEST(Bodies, WhoseSpheresAreMissedAreNotAsked) {
    struct Counting {
        mutable int asked = 0;
        std::optional<Hit> trace(const glm::vec3&, const glm::vec3&, float) const {
            ++asked;
            return {};
        }
    } method;
    Bodies<Counting> bodies;
    for (int i = 0; i < 10; ++i)
        bodies.placed.push_back(
            place(method, {{0, 0, 0}, 1}, glm::translate(glm::mat4(1), glm::vec3(3 * i, 0, -5))));
    EXPECT_FALSE(bodies.trace({0, 0, 0}, {0, 0, -1}, 0));
    EXPECT_EQ(method.asked, 1);
    EXPECT_FALSE(bodies.trace({0, 0, 0}, {0, 0, -1}, 7));
    EXPECT_EQ(method.asked, 1);
}

} // namespace
} // namespace shoal::occlusion
