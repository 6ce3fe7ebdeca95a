#include "engine/media/StereoView.h"

#include "engine/core/Random.h"

#include <gtest/gtest.h>

#include <array>

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

// Blocks of noise, the second eye shifted by a block and a half of disparity against the first.
ImageRgb8 stereoPair(bool topBottom) {
    ImageRgb8 frame(320, 180);
    Random random(3);
    std::array<uint8_t, 64 * 64> blocks{};
    for (auto& block : blocks) block = static_cast<uint8_t>(random.below(256));
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) {
            const bool second = topBottom ? y >= 90 : x >= 160;
            const int eyeX = topBottom ? x : x % 160, eyeY = topBottom ? y % 90 : y;
            const int shifted = eyeX + (second ? 3 : 0);
            frame.at(x, y)[0] = frame.at(x, y)[1] = frame.at(x, y)[2] =
                blocks[static_cast<size_t>(eyeY / 30 * 64 + shifted / 40)];
        }
    return frame;
}

TEST(StereoView, ContentTellsTwoEyesFromOne) {
    EXPECT_EQ(layoutFromContent(stereoPair(true)), Layout::TopBottom);
    EXPECT_EQ(layoutFromContent(stereoPair(false)), Layout::LeftRight);
}

// Water in a panorama: bright above, dark below, the same all around. Its halves have equal gradients, and
// left and right are alike; neither makes it stereo.
TEST(StereoView, AGradientIsMono) {
    ImageRgb8 frame(320, 180);
    Random random(4);
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x)
            for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = static_cast<uint8_t>(240 - y + random.below(5));
    EXPECT_NE(layoutFromContent(frame), Layout::TopBottom);
    EXPECT_EQ(layoutFromContent(ImageRgb8(64, 36)), Layout::Mono) << "blank";
    EXPECT_EQ(layoutFromContent(ImageRgb8(1, 1)), Layout::Mono);
}

} // namespace
} // namespace shoal::media
