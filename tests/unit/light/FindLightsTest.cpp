// Lights of known place, size and strength are found there, and none is found where there is none.
#include "tests/Test.h"
#include "tests/unit/light/LightWatcher.h"

namespace shoal::light {
namespace {

template <class Picture> FoundLights lightsIn(const Picture& picture) { return LightWatcher().look(picture); }

// A texel of the pyramid's base is 0.7 degrees wide.
TEST(FindLights, FourTexelSunsAreFoundWhereTheyStand) {
    for (const auto& [column, row] :
         {std::pair(300, 0), {511, 255}, {1023, 255}, {200, 4}, {700, 509}, {130, 77}}) {
        ImageRgbF sky = uniform(1024, glm::dvec3(1));
        for (int i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c) sky.at((column + i % 2) % 1024, row + i / 2)[c] = 1e4f;
        const FoundLights found = lightsIn(sky);
        ASSERT_EQ(found.count, 1u) << column << ", " << row;
        const FoundLight& light = found.lights[0];
        const glm::dvec3 middle = directionFromLatLong(glm::dvec2((column + 1.0) / 1024, (row + 1.0) / 512));
        EXPECT_LT(degreesBetween(light.direction, middle), 0.6) << column << ", " << row;
        EXPECT_LT(light.radius, 0.03f); // about a texel of the level that is looked at
        const double flux =
            2 * (1e4 - 1) * (texelSolidAngle(row, 1024, 512) + texelSolidAngle(row + 1, 1024, 512));
        EXPECT_NEAR(light.irradiance.y, flux, 0.02 * flux) << column << ", " << row;
    }
}

// A display-coded frame shows these suns only as white on grey: discs of 0.4 degrees' radius, which at the
// horizon cover as many texels.
TEST(FindLights, FourTexelSunsOfAVideoToo) {
    for (const glm::dvec2& uv : {glm::dvec2(0.5, 0), glm::dvec2(0.3, 0.015), glm::dvec2(0.5, 0.5),
                                 glm::dvec2(0, 0.5), glm::dvec2(0.13, 0.2), glm::dvec2(0.7, 0.99)}) {
        const glm::dvec3 sun = directionFromLatLong(uv);
        ImageRgb8 frame(1024, 512);
        for (int y = 0; y < frame.height; ++y)
            for (int x = 0; x < frame.width; ++x) {
                const glm::dvec3 d = texelDirection<double>(x, y, 1024, 512);
                std::fill_n(frame.at(x, y), 3, degreesBetween(d, sun) < 0.4 ? uint8_t{255} : uint8_t{120});
            }
        const FoundLights found = lightsIn(frame);
        ASSERT_EQ(found.count, 1u) << uv.x << ", " << uv.y;
        EXPECT_LT(degreesBetween(found.lights[0].direction, sun), 0.6) << uv.x << ", " << uv.y;
    }
}

// A camera's picture of a sun in haze: its glow falls with the power 1.5 of the angle, as in a clear sky,
// and is clipped within 3 degrees of it. A lit cloud hangs 12 degrees beside it, a ridge may hide what is
// below.
ImageRgb8 hazySun(const glm::dvec3& sun, const glm::dvec3& cloud, double cloudRadiance, double ridge) {
    ImageRgb8 frame(1024, 512);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const glm::dvec3 d = texelDirection<double>(x, y, 1024, 512);
            const double away = degreesBetween(d, sun), aside = degreesBetween(d, cloud) / 10;
            const double sky =
                0.15 + 5 * std::pow(std::max(away, 0.3), -1.5) + cloudRadiance * std::exp(-aside * aside);
            const double seen = d.y < ridge ? 0.05 : std::min(sky, 1.0);
            std::fill_n(frame.at(x, y), 3,
                        static_cast<uint8_t>(255 * math::srgbFromLinear(static_cast<float>(seen)) + 0.5f));
        }
    return frame;
}

TEST(FindLights, AClippedSunIsFoundInALopsidedGlow) {
    for (const double azimuth_deg : {0.0, 77.0, 181.0})
        for (const double height_deg : {15.0, 50.0}) {
            const auto at = [&](double up_deg) {
                return directionFromLatLong(glm::dvec2(azimuth_deg / 360, 0.5 - (height_deg + up_deg) / 180));
            };
            const glm::dvec3 sun = at(0);
            for (const double cloud : {0.0, 0.4})                    // as bright as half of what is clipped
                for (const double ridge_deg : {-90.0, -2.0, -1.0}) { // of the sun's height
                    const FoundLights found =
                        lightsIn(hazySun(sun, at(12), cloud, std::sin(glm::radians(height_deg + ridge_deg))));
                    SCOPED_TRACE(testing::Message() << "cloud " << cloud << ", ridge " << ridge_deg
                                                    << ", height " << height_deg);
                    ASSERT_GT(found.count, 0u);
                    EXPECT_LT(degreesBetween(found.lights[0].direction, sun), 2);
                    EXPECT_LT(glm::degrees(found.lights[0].radius), 6);
                }
        }
}

// Caps from a lamp's size to that of Snell's window, whose radius is 48.6 degrees.
TEST(FindLights, CapsAreFoundWithTheirSizeAndStrength) {
    for (const double radius_deg : {3.0, 10.0, 25.0, 40.0, 48.6})
        for (const glm::dvec3& towards :
             {glm::dvec3(0, 1, 0), glm::dvec3(0.2, 0.97, -0.1), glm::dvec3(0, 0, 1), glm::dvec3(0.1, -1, 0),
              glm::dvec3(-0.7, 0.2, 0.6)}) {
            const glm::dvec3 middle = glm::normalize(towards);
            const double cosine = std::cos(glm::radians(radius_deg));
            const glm::dvec3 within(6, 5, 4), without(0.3, 0.4, 0.5);
            const FoundLights found = lightsIn(paint(512, 256, [&](const glm::dvec3& d) {
                return glm::dot(d, middle) > cosine ? within : without;
            }));
            SCOPED_TRACE(radius_deg);
            ASSERT_EQ(found.count, 1u);
            const FoundLight& light = found.lights[0];
            EXPECT_LT(degreesBetween(light.direction, middle), 0.6);
            EXPECT_NEAR(glm::degrees(static_cast<double>(light.radius)), radius_deg, 0.6 + 0.08 * radius_deg);
            // The edge crosses coarse texels, 5.6 degrees wide: some of them count in part.
            const double form = std::numbers::pi * (1 - cosine * cosine);
            const double slack = radius_deg < 5 ? 0.15 : 0.08;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(light.irradiance[c], (within - without)[c] * form,
                            slack * (within - without)[c] * form);
        }
}

TEST(FindLights, TwoDominantLightsAreTwoLightsTheStrongerFirst) {
    const glm::dvec3 strong(0, 0.6, -0.8), weak(0, 0.6, 0.8);
    const FoundLights found = lightsIn(paint(512, 256, [&](const glm::dvec3& d) {
        return glm::dvec3(glm::dot(d, strong) > 0.98 ? 9.0 : glm::dot(d, weak) > 0.98 ? 6.0 : 0.2);
    }));
    ASSERT_EQ(found.count, 2u);
    EXPECT_LT(degreesBetween(found.lights[0].direction, strong), 0.5);
    EXPECT_LT(degreesBetween(found.lights[1].direction, weak), 0.5);
}

TEST(FindLights, EvenLightHasNoSource) {
    EXPECT_EQ(lightsIn(uniform(512, glm::dvec3(0))).count, 0u) << "black";
    EXPECT_EQ(lightsIn(uniform(512, glm::dvec3(0.7, 0.8, 0.9))).count, 0u) << "uniform";
    const auto along = [](const glm::dvec3& axis) {
        return paint(512, 256, [=](const glm::dvec3& d) { return glm::dvec3(1 + 0.8 * glm::dot(d, axis)); });
    };
    EXPECT_EQ(lightsIn(along({0, 1, 0})).count, 0u) << "gradient upwards";
    EXPECT_EQ(lightsIn(along({0.6, 0, 0.8})).count, 0u) << "gradient sideways";
    EXPECT_EQ(lightsIn(paint(512, 256, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0); })).count, 0u)
        << "half black, half white";
    EXPECT_LT(lightsIn(noise(1024, 512)).lights[0].share, 1e-3f) << "noise";
    ImageRgb8 grain(1024, 512);
    uint32_t seed = 1;
    for (uint8_t& value : grain.pixels)
        value = static_cast<uint8_t>(127 + ((seed = seed * 1664525u + 1013904223u) >> 30) % 3);
    EXPECT_EQ(lightsIn(grain).count, 0u) << "a sensor's noise";
}

TEST(FindLights, GroundIsLitByTheUpperHalf) {
    const FoundLights found = lightsIn(
        paint(512, 256, [](const glm::dvec3& d) { return d.y > 0 ? glm::dvec3(2, 1, 0.5) : glm::dvec3(9); }));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found.groundIrradiance[c], std::numbers::pi * glm::dvec3(2, 1, 0.5)[c], 0.01);
}

constexpr float kFrame_s = 1 / 24.0f;

struct Watcher : LightWatcher {
    const ShadowLight& see(const ImageRgbF& environment, float dt_s = kFrame_s) {
        return steady.follow(look(environment), dt_s);
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
    found.lights[0].direction = towards(105, 60);
    EXPECT_LT(degreesBetween(steady.follow(found, -60).light.direction, before), 1)
        << "a dive that begins anew";
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
