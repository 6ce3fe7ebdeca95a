#include "engine/media/StereoView.h"

#include "engine/core/Random.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace shoal::media {
namespace {

TEST(StereoView, EyesCoverTheirHalves) {
    const auto expect = [](Layout layout, int eye, std::array<int, 4> wanted) {
        const EyePart part = eyePart(layout, eye, 101, 51);
        EXPECT_EQ((std::array{part.x, part.y, part.width, part.height}), wanted) << enumName(layout) << eye;
    };
    for (const int eye : {0, 1}) expect(Layout::Mono, eye, {0, 0, 101, 51});
    expect(Layout::TopBottom, 0, {0, 0, 101, 25}); // the left eye is above
    expect(Layout::TopBottom, 1, {0, 25, 101, 25});
    expect(Layout::LeftRight, 0, {0, 0, 50, 51});
    expect(Layout::LeftRight, 1, {50, 0, 50, 51});
}

TEST(StereoView, ShapeTellsWhereItCan) {
    EXPECT_EQ(layoutFromShape(2048, 1024), Layout::Mono);
    EXPECT_EQ(layoutFromShape(426, 214), Layout::Mono);
    EXPECT_EQ(layoutFromShape(2048, 2048), Layout::TopBottom);
    EXPECT_EQ(layoutFromShape(8192, 2048), Layout::LeftRight);
    EXPECT_EQ(layoutFromShape(1920, 1080), Layout::Auto);
    EXPECT_EQ(layoutFromShape(5470, 3646), Layout::Auto);
}

using Brightness = std::function<double(double u, double v)>; // of one eye's picture, 0 to 1 each way

// Noise of cells, smooth between them and around: `across` cells around, half as many down.
Brightness noise(int across, uint64_t seed) {
    Random random(seed);
    std::vector<double> cells(static_cast<size_t>(across * (across / 2 + 1)));
    for (double& cell : cells) cell = random.below(256);
    return [=](double u, double v) {
        const double x = (u - std::floor(u)) * across, y = std::clamp(v, 0.0, 0.999) * (across / 2);
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const auto cell = [&](int i, int j) {
            return cells[static_cast<size_t>((row + j) * across + (column + i) % across)];
        };
        return std::lerp(std::lerp(cell(0, 0), cell(1, 0), x - column),
                         std::lerp(cell(0, 1), cell(1, 1), x - column), y - row);
    };
}

ImageRgb8 drawn(int width, int height, const Brightness& at) {
    ImageRgb8 frame(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::fill_n(
                frame.at(x, y), 3,
                static_cast<uint8_t>(std::clamp(at((x + 0.5) / width, (y + 0.5) / height), 0.0, 255.0)));
    return frame;
}

// Returns the pictures of both eyes. Lower parts are nearer, and shifted by up to `disparity` of the width.
ImageRgb8 stereoPair(bool topBottom, const Brightness& seen, int width = 512, int height = 256,
                     double disparity = 0.02) {
    return drawn(width, height, [&](double u, double v) {
        double& across = topBottom ? v : u;
        const bool second = across >= 0.5;
        across = 2 * across - (second ? 1 : 0);
        return seen(u + (second ? disparity * v : 0), v);
    });
}

TEST(StereoView, ContentTellsTwoEyesFromOne) {
    for (const auto& [width, height] : {std::pair(512, 256), {320, 180}, {256, 256}, {4096, 2048}})
        for (const uint64_t seed : {1, 2, 3}) {
            const Brightness seen = noise(32, seed);
            EXPECT_EQ(layoutFromContent(stereoPair(true, seen, width, height)), Layout::TopBottom) << width;
            EXPECT_EQ(layoutFromContent(stereoPair(false, seen, width, height)), Layout::LeftRight) << width;
            EXPECT_EQ(layoutFromContent(drawn(width, height, seen)), Layout::Mono) << width;
        }
    // A picture beside its copy is a stereo pair too.
    EXPECT_EQ(layoutFromContent(stereoPair(false, noise(32, 4), 512, 256, 0)), Layout::LeftRight);
    // Shifted further than anything at an arm's length: another picture.
    EXPECT_EQ(layoutFromContent(drawn(512, 256,
                                      [seen = noise(32, 5)](double u, double v) {
                                          return seen(u < 0.5 ? 2 * u : 2 * u + 0.4, v);
                                      })),
              Layout::Mono);
}

// Content decides where the shape is 2:1, shape elsewhere.
TEST(StereoView, SqueezedPairsAreFoundByContent) {
    const Brightness seen = noise(32, 6);
    EXPECT_EQ(layoutOf(stereoPair(true, seen)), Layout::TopBottom);
    EXPECT_EQ(layoutOf(stereoPair(false, seen)), Layout::LeftRight);
    EXPECT_EQ(layoutOf(drawn(512, 256, seen)), Layout::Mono);
    EXPECT_EQ(layoutOf(drawn(256, 256, seen)), Layout::TopBottom) << "by shape";
    EXPECT_EQ(layoutOf(ImageRgb8(512, 256)), Layout::Mono) << "blank";
}

// Frames without structure give no layout: blank frames, fades, plain water with a gradient and noise.
TEST(StereoView, WithoutStructureNothingIsSaid) {
    EXPECT_EQ(layoutFromContent(ImageRgb8(64, 32)), Layout::Auto);
    EXPECT_EQ(layoutFromContent(ImageRgb8(1, 1)), Layout::Auto);
    const Brightness seen = noise(32, 7);
    EXPECT_EQ(layoutFromContent(stereoPair(false, [&](double u, double v) { return seen(u, v) / 40; })),
              Layout::Auto);
    Random random(4);
    EXPECT_EQ(
        layoutFromContent(drawn(512, 256, [&](double, double v) { return 240 - 200 * v + random.below(5); })),
        Layout::Auto);
}

// Rooms that are the same to the left and to the right: mirrored about the middle, or about each half's.
TEST(StereoView, MirrorSymmetricRoomsAreMono) {
    for (const uint64_t seed : {8, 9, 10}) {
        const Brightness seen = noise(32, seed);
        EXPECT_EQ(layoutFromContent(
                      drawn(512, 256, [&](double u, double v) { return seen(std::abs(u - 0.5), v); })),
                  Layout::Mono);
        EXPECT_EQ(layoutFromContent(
                      drawn(512, 256, [&](double u, double v) { return seen(u, std::abs(v - 0.5)); })),
                  Layout::Mono);
    }
}

// Films of 24 frames. frame(i): brightness of frame i.
Layout layoutOfFilm(const std::function<ImageRgb8(int)>& frame) {
    const TempFolder folder;
    const Path file = folder.path() / "film.avi";
    {
        cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 24,
                               {512, 256});
        for (int i = 0; i < 24; ++i) {
            const ImageRgb8 picture = frame(i);
            writer.write(cv::Mat(256, 512, CV_8UC3, const_cast<uint8_t*>(picture.pixels.data())));
        }
    }
    auto player = VideoPlayer::open(file);
    if (!player) throw std::runtime_error(player.error().message());
    EXPECT_EQ((*player).waitFor(0)->number, 0) << "it begins with its first frame";
    return (*player).info().layout;
}

TEST(StereoView, AFilmGoesByFramesThatHaveStructure) {
    const Brightness seen = noise(32, 11);
    const ImageRgb8 pair = stereoPair(false, seen), one = drawn(512, 256, seen), black(512, 256);
    EXPECT_EQ(layoutOfFilm([&](int) { return pair; }), Layout::LeftRight);
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 6 ? black : pair; }), Layout::LeftRight) << "fades in";
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 6 ? black : one; }), Layout::Mono);
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 2 ? pair : one; }), Layout::Mono) << "frames disagree";
    EXPECT_EQ(layoutOfFilm([&](int) { return black; }), Layout::Mono);
}

} // namespace
} // namespace shoal::media
