#include "engine/light/BlockMeans.h"
#include "engine/light/ClippedLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"

#include <gtest/gtest.h>

#include <cmath>

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
    std::vector<float> weights(static_cast<size_t>(height), 0.25f);
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
    const int width = 64, height = 4;
    ImageRgb8 frame(width, height);
    ImageRgbF out(width / 4, 1);
    const std::vector<float> weights(4, 0.25f);
    double worst = 0;
    for (int red = 0; red < 256; red += 5)
        for (int green = 0; green < 256; green += 3)
            for (int blue = 0; blue < 256; blue += 15) {
                for (size_t i = 0; i < frame.pixels.size(); i += 3) {
                    frame.pixels[i] = static_cast<uint8_t>(red);
                    frame.pixels[i + 1] = static_cast<uint8_t>(green);
                    frame.pixels[i + 2] = static_cast<uint8_t>(blue);
                }
                makeBlockMeans({frame.pixels.data(), width, height, 3 * width, false}, weights, out,
                               GetParam());
                const glm::dvec3 want = radianceOf(red, green, blue);
                for (int x = 0; x < out.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        worst = std::max(worst, std::abs(static_cast<double>(out.at(x, 0)[c]) - want[c]) /
                                                    std::max(want[c], 1e-9));
            }
    EXPECT_LT(worst, kOff);
}

// Noise in a rectangle of a larger frame, of a width that fills no loop evenly; it ends with the last texel.
struct NoisyFrame {
    static constexpr int kWidth = 4 * (8 * 3 + 7), kHeight = 16, kStride = 3 * kWidth + 11;
    std::vector<uint8_t> bytes = std::vector<uint8_t>(kStride * (kHeight - 1) + 3 * kWidth);

    explicit NoisyFrame(bool halfNearWhite) {
        uint32_t seed = 3;
        for (uint8_t& value : bytes) {
            seed = seed * 1664525u + 1013904223u;
            value = static_cast<uint8_t>(halfNearWhite && seed & 0x400000 ? 240 + (seed >> 28) : seed >> 24);
        }
    }
    FrameView view(bool bgr) const { return {bytes.data(), kWidth, kHeight, kStride, bgr}; }
    const uint8_t* at(int x, int y) const { return &bytes[static_cast<size_t>(y * kStride + 3 * x)]; }
};

// Both orders of bytes.
TEST_P(BlockMeans, NoiseGivesWeighedMeansTheSameForEveryLoop) {
    const NoisyFrame frame(false);
    constexpr int width = NoisyFrame::kWidth, height = NoisyFrame::kHeight;
    const std::vector<float> weights = weightsFor(height);
    for (const bool bgr : {true, false}) {
        ImageRgbF out(width / 4, height / 4), plain(width / 4, height / 4);
        const FrameView view = frame.view(bgr);
        makeBlockMeans(view, weights, out, GetParam());
        makeBlockMeans(view, weights, plain, BlockLoop::Plain);
        EXPECT_EQ(out.pixels, plain.pixels);
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x) {
                glm::dvec3 want(0);
                for (int i = 0; i < 16; ++i) {
                    const int row = 4 * y + i / 4;
                    const uint8_t* p = frame.at(4 * x + i % 4, row);
                    want += 0.25 * static_cast<double>(weights[static_cast<size_t>(row)]) *
                            radianceOf(p[bgr ? 2 : 0], p[1], p[bgr ? 0 : 2]);
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
    const int width = 64, height = 4;
    ImageRgb8 frame(width, height);
    ImageRgbF out(width / 4, 1);
    ImageF clipped;
    const std::vector<float> weights(4, 0.25f);
    for (int value = 0; value < 256; ++value)
        for (const bool bgr : {true, false}) {
            const std::array<int, 3> colour = {value, 255 - value, value / 2};
            for (size_t i = 0; i < frame.pixels.size(); ++i)
                frame.pixels[i] = static_cast<uint8_t>(colour[bgr ? 2 - i % 3 : i % 3]);
            makeLinearBlockMeans({frame.pixels.data(), width, height, 3 * width, bgr}, weights, {}, out,
                                 clipped, GetParam());
            for (int x = 0; x < out.width; ++x)
                for (size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(out.at(x, 0)[c], linearOf(colour[c]), allowed(colour[c])) << colour[c];
        }
}

// The same for decoded sRGB; half of the values are near white.
TEST_P(BlockMeans, NoiseGivesDecodedAndClippedMeansTheSameForEveryLoop) {
    const NoisyFrame frame(true);
    constexpr int width = NoisyFrame::kWidth, height = NoisyFrame::kHeight;
    const std::vector<float> weights = weightsFor(height);
    std::vector<float> shares(static_cast<size_t>(height), 1.0f);
    for (size_t y = 4; y < 8; ++y) shares[y] = static_cast<float>(8 - y) / 8;
    std::fill(shares.begin() + 8, shares.end(), 0.0f);
    for (const bool bgr : {true, false}) {
        ImageRgbF out(width / 4, height / 4), plain(width / 4, height / 4);
        ImageF clipped(width / 4, height / 4), plainClipped(width / 4, height / 4);
        const FrameView view = frame.view(bgr);
        makeLinearBlockMeans(view, weights, shares, out, clipped, GetParam());
        makeLinearBlockMeans(view, weights, shares, plain, plainClipped, BlockLoop::Plain);
        EXPECT_EQ(out.pixels, plain.pixels);
        EXPECT_EQ(clipped.pixels, plainClipped.pixels);
        makeLinearBlockMeans(view, weights, {}, plain, plainClipped, GetParam());
        EXPECT_EQ(out.pixels, plain.pixels);
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x) {
                glm::dvec3 want(0), off(0);
                double steps = 0;
                for (int i = 0; i < 16; ++i) {
                    const auto row = static_cast<size_t>(4 * y + i / 4);
                    const uint8_t* p = frame.at(4 * x + i % 4, 4 * y + i / 4);
                    const double weight = 0.25 * static_cast<double>(weights[row]);
                    for (int c = 0; c < 3; ++c) {
                        const int coded = p[bgr ? 2 - c : c];
                        want[c] += weight * linearOf(coded);
                        off[c] += weight * allowed(coded);
                    }
                    steps += weight * static_cast<double>(shares[row]) * clippedSteps(p);
                }
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(out.at(x, y)[c], want[c], off[c]) << x << ", " << y;
                EXPECT_NEAR(*clipped.at(x, y), steps / kClippedSteps, 1e-4) << x << ", " << y;
            }
    }
}

std::string nameOf(const testing::TestParamInfo<BlockLoop>& loop) {
    return loop.param == BlockLoop::Plain ? "Plain" : "Avx2";
}

INSTANTIATE_TEST_SUITE_P(Loops, BlockMeans, testing::Values(BlockLoop::Plain, BlockLoop::Avx2), nameOf);

} // namespace
} // namespace shoal::light
