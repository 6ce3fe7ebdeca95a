// The light that throws shadows does not jump in a film, and follows a cut at once.
#include "engine/light/FindLights.h"
#include "engine/light/Pyramid.h"
#include "tests/unit/light/Angles.h"
#include "tests/unit/light/Environments.h"

#include <gtest/gtest.h>

namespace shoal::light {
namespace {

constexpr float kFrame_s = 1 / 24.0f;

struct Watcher {
    PyramidMaker pyramid;
    RadiancePyramid radiance;
    LightFinder finder;
    FoundLights found;
    LightOverTime steady;

    const ShadowLight& see(const ImageRgbF& environment, float dt_s = kFrame_s) {
        pyramid.make(environment, 512, radiance);
        finder.find(radiance, found);
        return steady.follow(found, dt_s);
    }
};

// Returns an environment with a light of soft edges, so that it can stand between texels.
ImageRgbF dominantAt(const glm::dvec3& towards, double radius_deg = 6, double radiance = 10,
                     double rest = 0.5) {
    const double edge = std::cos(glm::radians(radius_deg)), soft = 0.3 * (1 - edge);
    return paint(256, 128, [&](const glm::dvec3& d) {
        return glm::dvec3(rest + radiance * std::clamp((glm::dot(d, towards) - edge) / soft, 0.0, 1.0));
    });
}

glm::dvec3 towards(double azimuth_deg, double elevation_deg) {
    return directionFromLatLong(glm::dvec2(azimuth_deg / 360, 0.5 - elevation_deg / 180));
}

TEST(LightOverTime, ASlowLightMovesWithoutAJumpAndIsNotFarBehind) {
    struct Way {
        double azimuth, elevation, along, up; // degrees, and degrees a frame
    };
    for (const Way& way : {Way{100, 20, 0.4, 0}, Way{358, 5, 0.3, 0.1}, Way{40, 84, 0, 0.3}}) {
        Watcher watcher;
        glm::dvec3 before(0);
        for (int frame = 0; frame < 48; ++frame) {
            const glm::dvec3 truth = towards(way.azimuth + frame * way.along, way.elevation + frame * way.up);
            const ShadowLight& now = watcher.see(dominantAt(truth));
            if (frame > 0) {
                EXPECT_LT(degreesBetween(now.light.direction, before), 1) << "frame " << frame;
            }
            // 0.15 s of up to 10 degrees a second behind, and what finding is off.
            EXPECT_LT(degreesBetween(now.light.direction, truth), 2) << "frame " << frame;
            EXPECT_GT(now.presence, 0.99f);
            before = now.light.direction;
        }
    }
}

// A clipped sun whose edge breaks up at random is found up to 3 degrees off, anew in each frame.
TEST(LightOverTime, AShakyLightIsCalm) {
    LightOverTime steady;
    FoundLights found;
    found.count = 1;
    found.thumb.fill(1);
    glm::dvec3 before(0);
    uint32_t seed = 7;
    for (int frame = 0; frame < 200; ++frame) {
        const auto dice = [&] {
            return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) * 0x1p-24;
        };
        found.lights[0] = {towards(100 + 4 * dice(), 60 + 4 * dice()), 0.1f, glm::vec3(1), 0.4f};
        const ShadowLight& now = steady.follow(found, kFrame_s);
        if (frame > 0) {
            EXPECT_LT(degreesBetween(now.light.direction, before), 1);
        }
        before = now.light.direction;
    }
}

TEST(LightOverTime, ACutIsFollowedAtOnce) {
    Watcher watcher;
    for (int frame = 0; frame < 10; ++frame) watcher.see(dominantAt(towards(50, 40)));
    const glm::dvec3 there = towards(200, 10);
    const ShadowLight& now = watcher.see(dominantAt(there, 20, 3, 0.1));
    EXPECT_LT(degreesBetween(now.light.direction, there), 0.5);
    EXPECT_EQ(now.presence, 1);
    EXPECT_EQ(watcher.see(uniform(256, glm::dvec3(0.01))).presence, 0) << "to the dark";
    EXPECT_EQ(watcher.see(uniform(256, glm::dvec3(0.01))).presence, 0);
    EXPECT_EQ(watcher.see(dominantAt(there)).presence, 1) << "and back";
}

// One dominant light goes down as another comes up: never is there a shadow of anything in between.
TEST(LightOverTime, OneLightFadesBeforeAnotherTakesOver) {
    Watcher watcher;
    const glm::dvec3 first = towards(90, 50), second = towards(250, 30);
    float minimum = 1;
    bool over = false;
    for (int frame = 0; frame < 120; ++frame) {
        const double share = std::clamp((frame - 20) / 40.0, 0.0, 1.0);
        const ImageRgbF a = dominantAt(first, 6, 10 * (1 - share)), b = dominantAt(second, 6, 10 * share, 0);
        ImageRgbF both = a;
        for (size_t i = 0; i < both.pixels.size(); ++i) both.pixels[i] += b.pixels[i];
        const ShadowLight& now = watcher.see(both);
        const double toFirst = degreesBetween(now.light.direction, first),
                     toSecond = degreesBetween(now.light.direction, second);
        EXPECT_LT(std::min(toFirst, toSecond), 2) << "frame " << frame;
        over |= toSecond < toFirst;
        EXPECT_TRUE(!over || toSecond < 2) << "and not back";
        minimum = std::min(minimum, now.presence);
    }
    EXPECT_TRUE(over);
    EXPECT_LT(minimum, 0.03f);
    EXPECT_GT(watcher.see(dominantAt(second)).presence, 0.95f);
}

TEST(LightOverTime, ALightThatGoesOutFadesOverFrames) {
    Watcher watcher;
    float before = watcher.see(dominantAt(towards(90, 50), 3, 2)).presence;
    for (int frame = 0; frame < 48; ++frame) {
        const float now = watcher.see(uniform(256, glm::dvec3(0.5))).presence;
        EXPECT_LT(before - now, 0.2f);
        before = now;
    }
    EXPECT_LT(before, 0.02f);
}

} // namespace
} // namespace shoal::light
