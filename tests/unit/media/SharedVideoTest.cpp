// The reference videos have the facts that their description states, and seeking agrees with playing.
#include "engine/core/Hash.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::media {
namespace {

struct Facts {
    const char* name;
    int width, height;
    double fps;
    int frames;
    Layout layout;
};

void PrintTo(const Facts& facts, std::ostream* stream) { *stream << facts.name; }

class SharedVideo : public testing::TestWithParam<Facts> {
  protected:
    void SetUp() override {
        file = sharedData(std::string("video/") + GetParam().name);
        if (file.empty()) GTEST_SKIP() << "no shared video/" << GetParam().name;
    }
    Path file;
};

uint64_t hashOf(const ImageRgb8& picture) {
    Hash hash;
    hash.bytes(picture.pixels.data(), picture.pixels.size());
    return hash.value();
}

TEST_P(SharedVideo, HasItsFacts) {
    const Facts& facts = GetParam();
    const auto player = VideoPlayer::open(file);
    ASSERT_TRUE(player) << player.error().message();
    const VideoInfo* info = &player->info();
    EXPECT_EQ(info->width, facts.width);
    EXPECT_EQ(info->height, facts.height);
    EXPECT_NEAR(info->fps, facts.fps, 0.005); // stated to two decimals
    EXPECT_EQ(info->codec, "h264");
    EXPECT_EQ(info->layout, facts.layout) << info->layoutSource;
    EXPECT_NEAR(static_cast<double>(info->frameCount), facts.frames, 0.01 * facts.frames);
    const auto check = checkVideo(file);
    EXPECT_TRUE(check) << check.error().message();
}

// Played in order, over the loop; then the same pictures by jumps in a fresh player.
TEST_P(SharedVideo, PlaysAndSeeksAlike) {
    const Facts& facts = GetParam();
    auto opened = VideoPlayer::open(file);
    ASSERT_TRUE(opened) << opened.error().message();
    auto player = std::move(opened).value();
    const double fps = player.info().fps;
    const int played = facts.frames + 5;
    std::vector<uint64_t> hashes;
    int64_t passLength = 0;
    for (int i = 0; i < played; ++i) {
        const VideoFrame* frame = player.waitFor(i / fps);
        ASSERT_EQ(frame->index, i);
        if (i > 0 && frame->number == 0) passLength = i;
        hashes.push_back(hashOf(frame->pixelsBgr));
    }
    EXPECT_EQ(player.status(), "");
    ASSERT_EQ(passLength, facts.frames);
    for (int i = facts.frames; i < played; ++i)
        EXPECT_EQ(hashes[static_cast<size_t>(i)], hashes[static_cast<size_t>(i - facts.frames)]);

    auto jumper = std::move(VideoPlayer::open(file)).value();
    for (const int index : {facts.frames - 1, 7, facts.frames / 2, facts.frames * 3 + 11, 1})
        EXPECT_EQ(hashOf(jumper.waitFor(index / fps)->pixelsBgr),
                  hashes[static_cast<size_t>(index % facts.frames)])
            << index;
}

INSTANTIATE_TEST_SUITE_P(
    Files, SharedVideo,
    testing::Values(Facts{"overpass_360_mono_2048x1024.mp4", 2048, 1024, 29.97, 120, Layout::Mono},
                    Facts{"congo_360_overunder_1920x1080.mp4", 1920, 1080, 917425.0 / 30618, 300,
                          Layout::TopBottom},
                    Facts{"richo_360_mono_426x214.mp4", 426, 214, 30, 1202, Layout::Mono}));

// Squeezes a picture to 2:1 by leaving rows out.
ImageRgb8 squeezed(const ImageRgb8& picture) {
    ImageRgb8 out(picture.width, picture.width / 2);
    for (int y = 0; y < out.height; ++y)
        std::copy_n(picture.at(0, y * picture.height / out.height), 3 * out.width, out.at(0, y));
    return out;
}

TEST(SharedVideos, SqueezedStereoIsFoundByContent) {
    const Path file = sharedData("video/congo_360_overunder_1920x1080.mp4");
    if (file.empty()) GTEST_SKIP() << "no shared video/congo_360_overunder_1920x1080.mp4";
    auto player = VideoPlayer::open(file);
    ASSERT_TRUE(player) << player.error().message();
    for (const double at_s : {0.0, 3.0, 6.0})
        EXPECT_EQ(layoutOf(squeezed((*player).waitFor(at_s)->pixelsBgr)), Layout::TopBottom) << at_s;
}

// Rooms and landscapes of one eye, one of them a room whose opposite walls are alike.
TEST(SharedHdrs, AreMonoByContent) {
    for (const char* name : {"fidelity/lightroom_14b_1k.hdr", "fidelity/aircraft_workshop_01_1k.hdr",
                             "hdr/studio_small_03_1k.hdr", "hdr/st_fagans_interior_1k.hdr"}) {
        const Path file = sharedData(name);
        if (file.empty()) GTEST_SKIP() << "no shared " << name;
        const auto picture = readHdr(file);
        ASSERT_TRUE(picture) << picture.error().message();
        ImageRgb8 coded(picture->radianceLin.width, picture->radianceLin.height);
        for (size_t i = 0; i < coded.pixels.size(); ++i)
            coded.pixels[i] =
                static_cast<uint8_t>(255 * std::sqrt(std::clamp(picture->radianceLin.pixels[i], 0.0f, 1.0f)));
        EXPECT_EQ(layoutOf(coded), Layout::Mono) << name;
    }
}

TEST(SharedPhotos, HaveTheirFactsAndLayout) {
    const struct {
        const char* name;
        int width, height;
        Layout layout;
    } kFacts[] = {{"coral_underwater_360_overunder_2048.jpg", 2048, 2048, Layout::TopBottom},
                  {"petra_360_2048x1024.jpg", 2048, 1024, Layout::Mono},
                  {"puydesancy_360_4096x2048.jpg", 4096, 2048, Layout::Mono}};
    for (const auto& facts : kFacts) {
        const Path file = sharedData(std::string("photo/") + facts.name);
        if (file.empty()) GTEST_SKIP() << "no shared photo/" << facts.name;
        const auto picture = readPicture(file);
        ASSERT_TRUE(picture) << picture.error().message();
        EXPECT_EQ(picture->width, facts.width);
        EXPECT_EQ(picture->height, facts.height);
        EXPECT_EQ(layoutFromShape(picture->width, picture->height), facts.layout);
        EXPECT_EQ(layoutFromContent(*picture), facts.layout) << facts.name;
        EXPECT_EQ(layoutOf(squeezed(*picture)), facts.layout) << facts.name;
    }
}

} // namespace
} // namespace shoal::media
