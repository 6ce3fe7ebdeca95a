// Lights of the game's own film are found where its scene has them, and do not jump.
#include "engine/media/VideoPlayer.h"
#include "tests/Test.h"
#include "tests/accuracy/light/RadianceFile.h"
#include "tests/unit/light/LightWatcher.h"

#include <fmt/format.h>

namespace shoal::light {
namespace {

TEST(FilmSun, IsFoundAndDoesNotJump) {
    auto player = media::VideoPlayer::open(dataRoot() / "content/video/reef.mp4");
    if (!player) GTEST_SKIP() << player.error().message();
    // content/make/video/Reef.toml: 58 degrees high in air, 66.7 in water of index 1.34; azimuth 205 degrees
    // from -Z over +X.
    const double up = glm::radians(66.7), round = glm::radians(205.0);
    const glm::dvec3 sun(std::cos(up) * std::sin(round), std::sin(up), -std::cos(up) * std::cos(round));
    LightWatcher eye;
    glm::dvec3 before(0);
    double sum = 0;
    constexpr int kFrames = 240;
    for (int i = 0; i < kFrames; ++i) { // the camera glides over open sand
        const auto* frame = player->waitFor(4 + (i + 0.5) / player->info().fps);
        const ShadowLight& now =
            eye.steady.follow(eye.look(frame->pixelsBgr, true), static_cast<float>(1 / player->info().fps));
        // Waves and clouds move the clipped area around the sun by some degrees.
        EXPECT_LT(degreesBetween(now.light.direction, sun), 6) << "frame " << i;
        if (i > 0) {
            EXPECT_LT(degreesBetween(now.light.direction, before), 1) << "frame " << i;
        }
        EXPECT_EQ(now.presence, 1) << "frame " << i;
        before = now.light.direction;
        sum += degreesBetween(now.light.direction, sun);
    }
    EXPECT_LT(sum / kFrames, 3);
}

// content/truth holds a few frames as they were before the camera: suns with a clipped glow, clouds and waves
// about them, and the tunnel's mouth.
TEST(FilmSun, LightsAreFoundWhereTheyWereBeforeTheCamera) {
    auto player = media::VideoPlayer::open(dataRoot() / "content/video/reef.mp4");
    if (!player) GTEST_SKIP() << player.error().message();
    LightWatcher eye;
    for (const int frame : {120, 560, 860, 1060, 1260}) {
        const Path file = dataRoot() / fmt::format("content/truth/reef_{:04}.hdr", frame);
        const auto before = readRadianceFile(file);
        ASSERT_TRUE(before) << file;
        const FoundLights truth = eye.look(*before);
        const FoundLights found = eye.look(player->waitFor(frame / player->info().fps)->pixelsBgr, true);
        ASSERT_GT(truth.count, 0u);
        ASSERT_GT(found.count, 0u);
        // 2.2 degrees for frame 120, whose sun merges with a cloud; 0.6 to 1.6 for the others.
        EXPECT_LT(degreesBetween(found.lights[0].direction, truth.lights[0].direction), 2.4)
            << "frame " << frame;
    }
}

} // namespace
} // namespace shoal::light
