// The sun of the game's own film is found where the film's maker has put it, and does not jump.
#include "engine/light/LightOverTime.h"
#include "engine/light/Pyramid.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/light/Angles.h"

#include <gtest/gtest.h>

namespace shoal::light {
namespace {

TEST(FilmSun, IsFoundAndDoesNotJump) {
    const Path file = dataRoot() / "content/video/reef.mp4";
    auto player = media::VideoPlayer::open(file);
    if (!player) GTEST_SKIP() << player.error().sentence();
    // content/make/video/Reef.toml: 58 degrees high in air, 66.7 in water of index 1.34; azimuth 205 degrees
    // from -Z over +X.
    const double up = glm::radians(66.7), round = glm::radians(205.0);
    const glm::dvec3 sun(std::cos(up) * std::sin(round), std::sin(up), -std::cos(up) * std::cos(round));
    PyramidMaker pyramid;
    RadiancePyramid radiance;
    LightFinder finder;
    FoundLights found;
    LightOverTime steady;
    glm::dvec3 before(0);
    double sum = 0;
    int seen = 0;
    for (int i = 0; i < 240; ++i) { // the camera glides over open sand
        const auto* frame = player->waitFor(4 + (i + 0.5) / player->info().fps);
        const ImageRgb8& picture = frame->pixelsBgr;
        pyramid.make(
            {picture.pixels.data(), picture.width, picture.height, ptrdiff_t{3} * picture.width, true}, 512,
            radiance);
        finder.find(radiance, found);
        const CastingLight& now = steady.follow(found, static_cast<float>(1 / player->info().fps));
        // Waves and clouds move by degrees what the camera clips about the sun.
        EXPECT_LT(degreesBetween(now.light.direction, sun), 6) << "frame " << i;
        if (i > 0) {
            EXPECT_LT(degreesBetween(now.light.direction, before), 1) << "frame " << i;
        }
        EXPECT_EQ(now.presence, 1) << "frame " << i;
        before = now.light.direction;
        sum += degreesBetween(now.light.direction, sun);
        ++seen;
    }
    EXPECT_LT(sum / seen, 3);
}

} // namespace
} // namespace shoal::light
