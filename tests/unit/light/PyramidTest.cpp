#include "engine/light/Pyramid.h"
#include "engine/light/BlockMeans.h"
#include "engine/light/ClippedLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "tests/Test.h"
#include "tests/unit/light/Environments.h"

namespace shoal::light {
namespace {

constexpr double kOff = 2e-4; // of the radiance: what the header promises

glm::dvec3 radianceOf(int red, int green, int blue) {
    const glm::dvec3 coded = glm::dvec3(red, green, blue) / 255.0;
    const double l = 0.30 * coded.x + 0.59 * coded.y + 0.11 * coded.z;
    return (10 * std::pow(l, 10) + 1.8) * coded;
}

// Even weights but for the first rows of blocks, which are a pole's.
std::vector<float> weightsFor(int height) {
    std::vector<float> weights(height, 0.25f);
    for (size_t y = 0; y < 4; ++y) weights[y] = static_cast<float>(2 * y + 1) / 16;
    return weights;
}

class BlockMeans : public testing::TestWithParam<BlockLoop> {
  protected:
    void SetUp() override {
        if (!canRun(GetParam())) GTEST_SKIP() << "not on this processor";
    }
};

// Whole frames of one colour, over all of them that share few digits: every value of luma that there is comes
// near one of these.
TEST_P(BlockMeans, OneColourGivesItsRadiance) {
    ImageRgbF out(16, 1);
    const std::vector<float> weights(4, 0.25f);
    double worst = 0;
    for (int red = 0; red < 256; red += 5)
        for (int green = 0; green < 256; green += 3)
            for (int blue = 0; blue < 256; blue += 15) {
                const ImageRgb8 frame = evenFrame(64, 4, static_cast<uint8_t>(red),
                                                  static_cast<uint8_t>(green), static_cast<uint8_t>(blue));
                makeBlockMeans(viewOf(frame), FrameRadiance::Thesis, weights, out, GetParam());
                const glm::dvec3 want = radianceOf(red, green, blue);
                for (int x = 0; x < out.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        worst =
                            std::max(worst, std::abs(out.at(x, 0)[c] - want[c]) / std::max(want[c], 1e-9));
            }
    EXPECT_LT(worst, kOff);
}

struct Bytes {
    std::vector<uint8_t> data;
    FrameView view;
};

// Noise in a rectangle inside a larger frame whose other bytes are white: a stride read wrongly shows. The
// memory ends with the last pixel.
Bytes frame(int width, int height, bool bgr, bool halfNearWhite = false) {
    Bytes bytes;
    const int rowBytes = 3 * width, stride = rowBytes + 11;
    bytes.data.assign(static_cast<size_t>(stride * (height - 1) + rowBytes), 255);
    uint32_t seed = 7;
    for (int y = 0; y < height; ++y)
        for (int i = 0; i < rowBytes; ++i) {
            seed = seed * 1664525u + 1013904223u;
            bytes.data[y * stride + i] =
                static_cast<uint8_t>(halfNearWhite && seed & 0x400000 ? 240 + (seed >> 28) : seed >> 24);
        }
    bytes.view = {bytes.data.data(), width, height, stride, bgr};
    return bytes;
}

constexpr int kNoiseWidth = 4 * (8 * 3 + 7), kNoiseHeight = 16; // fills no loop evenly

// Both orders of bytes.
TEST_P(BlockMeans, NoiseGivesWeighedMeansTheSameForEveryLoop) {
    const std::vector<float> weights = weightsFor(kNoiseHeight);
    for (const bool bgr : {true, false}) {
        ImageRgbF out(kNoiseWidth / 4, kNoiseHeight / 4), plain(out.width, out.height);
        const Bytes bytes = frame(kNoiseWidth, kNoiseHeight, bgr);
        const FrameView& view = bytes.view;
        makeBlockMeans(view, FrameRadiance::Thesis, weights, out, GetParam());
        makeBlockMeans(view, FrameRadiance::Thesis, weights, plain, BlockLoop::Plain);
        EXPECT_EQ(out.pixels, plain.pixels);
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x) {
                glm::dvec3 want(0);
                for (int i = 0; i < 16; ++i) {
                    const int row = 4 * y + i / 4;
                    const uint8_t* p = view.row(row) + 3 * (4 * x + i % 4);
                    want += 0.25 * weights[row] * radianceOf(p[bgr ? 2 : 0], p[1], p[bgr ? 0 : 2]);
                }
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(out.at(x, y)[c], want[c], kOff * want[c]) << x << ", " << y;
            }
    }
}

double linearOf(int coded) { return math::linearFromSrgb(coded / 255.0); }

// Returns the error of decoded sRGB that the header permits.
double allowed(int coded) { return std::min(2e-4, (coded < 10 ? 0.06 : 0.01) * linearOf(coded)) + 1e-9; }

// Every value, in each channel beside others.
TEST_P(BlockMeans, OneColourGivesDecodedSrgb) {
    ImageRgbF out(16, 1);
    const std::vector<float> weights(4, 0.25f);
    for (int value = 0; value < 256; ++value)
        for (const bool bgr : {true, false}) {
            const std::array<int, 3> colour = {value, 255 - value, value / 2};
            const ImageRgb8 frame =
                evenFrame(64, 4, static_cast<uint8_t>(colour[bgr ? 2 : 0]), static_cast<uint8_t>(colour[1]),
                          static_cast<uint8_t>(colour[bgr ? 0 : 2]));
            makeBlockMeans(viewOf(frame, bgr), FrameRadiance::Linear, weights, out, GetParam());
            for (int x = 0; x < out.width; ++x)
                for (size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(out.at(x, 0)[c], linearOf(colour[c]), allowed(colour[c])) << colour[c];
        }
}

// The same for decoded sRGB; half of the values are near white.
TEST_P(BlockMeans, NoiseGivesDecodedAndClippedMeansTheSameForEveryLoop) {
    const std::vector<float> weights = weightsFor(kNoiseHeight);
    std::vector<float> shares(kNoiseHeight, 1.0f);
    for (size_t y = 4; y < 8; ++y) shares[y] = static_cast<float>(8 - y) / 8;
    std::fill(shares.begin() + 8, shares.end(), 0.0f);
    for (const bool bgr : {true, false}) {
        ImageRgbF out(kNoiseWidth / 4, kNoiseHeight / 4), plain(out.width, out.height);
        ImageF clipped(out.width, out.height), plainClipped(out.width, out.height);
        const Bytes bytes = frame(kNoiseWidth, kNoiseHeight, bgr, true);
        const FrameView& view = bytes.view;
        makeBlockMeans(view, FrameRadiance::Auto, weights, out, GetParam(), shares, &clipped);
        makeBlockMeans(view, FrameRadiance::Auto, weights, plain, BlockLoop::Plain, shares, &plainClipped);
        EXPECT_EQ(out.pixels, plain.pixels);
        EXPECT_EQ(clipped.pixels, plainClipped.pixels);
        makeBlockMeans(view, FrameRadiance::Linear, weights, plain, GetParam());
        EXPECT_EQ(out.pixels, plain.pixels);
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x) {
                glm::dvec3 want(0), off(0);
                double steps = 0;
                for (int i = 0; i < 16; ++i) {
                    const int row = 4 * y + i / 4;
                    const uint8_t* p = view.row(row) + 3 * (4 * x + i % 4);
                    const double weight = 0.25 * weights[row];
                    for (int c = 0; c < 3; ++c) {
                        const int coded = p[bgr ? 2 - c : c];
                        want[c] += weight * linearOf(coded);
                        off[c] += weight * allowed(coded);
                    }
                    steps += weight * shares[row] * clippedSteps(p);
                }
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(out.at(x, y)[c], want[c], off[c]) << x << ", " << y;
                EXPECT_NEAR(*clipped.at(x, y), steps / kClippedSteps, 1e-4) << x << ", " << y;
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Loops, BlockMeans, testing::Values(BlockLoop::Plain, BlockLoop::Avx2),
                         [](const auto& loop) {
                             return std::string(loop.param == BlockLoop::Plain ? "Plain" : "Avx2");
                         });

ImageRgbF radianceOf(const FrameView& view) {
    ImageRgbF image(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const uint8_t* p = view.row(y) + 3 * x;
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
    for (int y = 0; y < 128; ++y) {
        const double top = texelSolidAngle(2 * y, 512, 256), bottom = texelSolidAngle(2 * y + 1, 512, 256);
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c) {
                const double want =
                    (top * (full.at(2 * x, 2 * y)[c] + full.at(2 * x + 1, 2 * y)[c]) +
                     bottom * (full.at(2 * x, 2 * y + 1)[c] + full.at(2 * x + 1, 2 * y + 1)[c])) /
                    (2 * (top + bottom));
                ASSERT_NEAR(pyramid.levels[0].at(x, y)[c], want, 1e-5); // floats up to 11.8
            }
    }
}

// Every value, in frames that are not made by blocks.
TEST(Pyramid, LinearFramesAreDecodedSrgb) {
    PyramidMaker maker;
    RadiancePyramid pyramid;
    ImageRgb8 greys(256, 128);
    for (size_t i = 0; i < greys.pixels.size(); ++i) greys.pixels[i] = static_cast<uint8_t>(i / 3);
    maker.make(viewOf(greys), 256, pyramid, FrameRadiance::Linear);
    for (int x = 0; x < 256; ++x) {
        const double want = math::linearFromSrgb(x / 255.0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(pyramid.levels[0].at(x, 7)[c], want, std::min(1e-5, 5e-4 * want) + 1e-9) << x;
    }
}

// Greys from black to white in frames of the base's size and of four times it, where blocks serve others.
TEST(Pyramid, OperatorsThatTheThesisNames) {
    for (const int width : {256, 1024}) {
        PyramidMaker maker;
        RadiancePyramid akyuz, landis;
        ImageRgb8 greys(width, width / 2);
        for (size_t i = 0; i < greys.pixels.size(); ++i)
            greys.pixels[i] = static_cast<uint8_t>(i / 3 * 256 / width);
        maker.make(viewOf(greys), 256, akyuz, FrameRadiance::Akyuz);
        maker.make(viewOf(greys), 256, landis, FrameRadiance::Landis);
        for (int x = 0; x < 256; ++x) {
            const double l = math::linearFromSrgb(x / 255.0), above = std::max(0.0, 2 * l - 1);
            EXPECT_NEAR(akyuz.levels[0].at(x, 7)[0], 10 * std::pow(l, 2.2), 1e-5) << x;
            EXPECT_NEAR(landis.levels[0].at(x, 7)[1], l * (1 + 9 * above * above), 1e-5) << x;
        }
    }
    // The range is the frame's own, and hues stay.
    const glm::vec3 orange(0.4f, 0.2f, 0.1f);
    const float l = linearLuminance(orange);
    EXPECT_LT(glm::length(akyuzRadiance(orange, 0, l) - 10.0f * orange / l), 1e-5f);
    EXPECT_LT(glm::length(akyuzRadiance(orange, l / 2, 3 * l / 2, 1, 1) - 0.5f * orange / l), 1e-5f);
    EXPECT_EQ(akyuzRadiance(orange, l, l), glm::vec3(0));
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
    maker.make(broken, 256, pyramid);
    EXPECT_EQ(pyramid.levels[0].at(3, 50)[0], 0.0f);
    EXPECT_EQ(pyramid.levels[0].at(4, 50)[1], 0.0f);
    EXPECT_EQ(pyramid.levels[0].at(5, 50)[2], kMaxHalf);
    EXPECT_EQ(pyramid.levels[0].at(6, 50)[0], kMaxRadianceIn);
    EXPECT_EQ(pyramid.levels[0].at(7, 50)[0], 1e9f);
}

} // namespace
} // namespace shoal::light
