#include "engine/light/Pyramid.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "tests/unit/light/Environments.h"

#include <gtest/gtest.h>

#include <limits>

namespace shoal::light {
namespace {

struct Bytes {
    std::vector<uint8_t> data;
    FrameView view;
};

// Noise in a rectangle inside a larger frame whose other bytes are white: a stride read wrongly shows.
Bytes frame(int width, int height, bool bgr, int margin = 5) {
    Bytes bytes;
    const int stride = (width + margin) * 3;
    bytes.data.assign(static_cast<size_t>(stride) * height, 255);
    uint32_t seed = 7;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width * 3; ++x) {
            seed = seed * 1664525u + 1013904223u;
            bytes.data[static_cast<size_t>(y * stride + x)] = static_cast<uint8_t>(seed >> 24);
        }
    bytes.view = {bytes.data.data(), width, height, stride, bgr};
    return bytes;
}

ImageRgbF radianceOf(const FrameView& view) {
    ImageRgbF image(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const uint8_t* p = view.pixels + y * view.rowStride + x * 3;
            const glm::vec3 coded = view.bgr ? glm::vec3(p[2], p[1], p[0]) : glm::vec3(p[0], p[1], p[2]);
            const glm::vec3 lin = radianceFromDisplay(coded / 255.0f);
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = lin[c];
        }
    return image;
}

struct Size {
    int width, height, asked, base;
};

class PyramidSizes : public testing::TestWithParam<Size> {};

// makeBlockMeans() is off by up to 2e-4, where that serves; the rest are sums of floats, each rounded at 6e-8
// of its size, over at most 1000 rows of random errors: 1e-5 with room.
TEST_P(PyramidSizes, EveryLevelHasTheMeanOfTheSource) {
    const auto [width, height, asked, base] = GetParam();
    for (const bool bgr : {true, false}) {
        const Bytes bytes = frame(width, height, bgr);
        RadiancePyramid pyramid;
        PyramidMaker maker;
        maker.make(bytes.view, asked, pyramid);
        EXPECT_EQ(pyramid.levels[0].width, base);
        EXPECT_EQ(pyramid.levels.back().width, 2);
        EXPECT_EQ(pyramid.levels.back().height, 1);
        const glm::dvec3 mean = meanOf(radianceOf(bytes.view));
        const bool byBlocks = width >= 4 * base && height >= 2 * base && width % 4 == 0 && height % 4 == 0;
        const double off = byBlocks ? 2e-4 : 1e-5;
        for (const ImageRgbF& level : pyramid.levels)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(meanOf(level)[c], mean[c], off * mean[c]) << "level " << level.width << " wide";
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PyramidSizes,
                         testing::Values(Size{512, 256, 256, 256}, Size{512, 256, 512, 512},
                                         Size{1024, 512, 256, 256}, Size{2048, 1024, 256, 256},
                                         Size{3072, 1536, 512, 512}, Size{2000, 1200, 256, 256},
                                         Size{1032, 512, 256, 256}, Size{426, 214, 1024, 256},
                                         Size{1920, 540, 1024, 1024}, Size{640, 320, 1024, 512},
                                         Size{100, 60, 1024, 256}, Size{1, 1, 1024, 256}));

TEST(Pyramid, HalvedFrameIsTheWeighedMeanOfFour) {
    const Bytes bytes = frame(512, 256, true);
    const ImageRgbF full = radianceOf(bytes.view);
    RadiancePyramid pyramid;
    PyramidMaker maker;
    maker.make(bytes.view, 256, pyramid);
    double worst = 0;
    for (int y = 0; y < 128; ++y) {
        const double top = texelSolidAngle(2 * y, 512, 256), bottom = texelSolidAngle(2 * y + 1, 512, 256);
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c) {
                const double want =
                    (top * (full.at(2 * x, 2 * y)[c] + full.at(2 * x + 1, 2 * y)[c]) +
                     bottom * (full.at(2 * x, 2 * y + 1)[c] + full.at(2 * x + 1, 2 * y + 1)[c])) /
                    (2 * (top + bottom));
                worst = std::max(worst, std::abs(want - static_cast<double>(pyramid.levels[0].at(x, y)[c])));
            }
    }
    EXPECT_LT(worst, 1e-5); // floats up to 11.8
}

// 4 x 4 pixels at a time against the texels one by one; rows with a margin, both orders. An eighth of the
// frame and a quarter of it.
TEST(Pyramid, BlocksOfFourAreTheirWeighedMeans) {
    for (const bool bgr : {true, false})
        for (const int asked : {256, 512}) {
            const Bytes bytes = frame(2048, 1024, bgr);
            RadiancePyramid pyramid, slow;
            PyramidMaker maker, slowMaker;
            maker.make(bytes.view, asked, pyramid);
            slowMaker.make(radianceOf(bytes.view), asked, slow);
            // Radiance up to 11.8, but of noise no texel is nearly as bright.
            EXPECT_LT(largestDifference(pyramid.levels[0], slow.levels[0]), 2e-4 * 4);
        }
}

// Every value, in frames that are not made by blocks.
TEST(Pyramid, LinearFramesAreDecodedSrgb) {
    PyramidMaker maker;
    RadiancePyramid pyramid;
    Bytes bytes = frame(256, 128, true, 0);
    for (size_t i = 0; i < bytes.data.size(); ++i) bytes.data[i] = static_cast<uint8_t>(i / 3);
    maker.make(bytes.view, 256, pyramid, FrameRadiance::Linear);
    for (int x = 0; x < 256; ++x) {
        const double want = math::linearFromSrgb(x / 255.0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(pyramid.levels[0].at(x, 7)[c], want, std::min(1e-5, 5e-4 * want) + 1e-9) << x;
    }
}

TEST(Pyramid, LinearSourceOfTheBasesSizeIsKept) {
    const ImageRgbF source = noise(512, 256);
    RadiancePyramid pyramid;
    PyramidMaker maker;
    EXPECT_EQ(maker.make(source, 512, pyramid), 0u);
    EXPECT_LT(largestDifference(pyramid.levels[0], source), 1e-6);
}

TEST(Pyramid, SizesMayChangeBetweenFrames) {
    PyramidMaker maker;
    RadiancePyramid used, fresh;
    maker.make(frame(640, 300, true).view, 512, used);
    const Bytes bytes = frame(300, 640, false);
    maker.make(bytes.view, 256, used);
    PyramidMaker().make(bytes.view, 256, fresh);
    for (size_t k = 0; k < fresh.levels.size(); ++k) EXPECT_EQ(used.levels[k].pixels, fresh.levels[k].pixels);
}

TEST(Pyramid, RepairsWhatIsNotLight) {
    ImageRgbF broken = uniform(256, glm::dvec3(1));
    broken.at(3, 50)[0] = std::numeric_limits<float>::quiet_NaN();
    broken.at(4, 50)[1] = -5.0f;
    broken.at(5, 50)[2] = std::numeric_limits<float>::infinity();
    broken.at(6, 50)[0] = 1e30f;
    broken.at(6, 50)[1] = -std::numeric_limits<float>::infinity();
    broken.at(7, 50)[0] = 1e9f; // a real sun may be so bright
    RadiancePyramid pyramid;
    PyramidMaker maker;
    EXPECT_EQ(maker.make(broken, 256, pyramid), 4u);
    EXPECT_EQ(pyramid.levels[0].at(3, 50)[0], 0.0f);
    EXPECT_EQ(pyramid.levels[0].at(4, 50)[1], 0.0f);
    EXPECT_EQ(pyramid.levels[0].at(5, 50)[2], kMaxHalf);
    EXPECT_EQ(pyramid.levels[0].at(6, 50)[0], kMaxRadianceIn);
    EXPECT_EQ(pyramid.levels[0].at(7, 50)[0], 1e9f);
}

} // namespace
} // namespace shoal::light
