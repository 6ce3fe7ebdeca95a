#include "engine/render/software/FrameSampler.h"

#include "engine/core/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace shoal::render {
namespace {

class FrameSampler : public testing::Test {
  protected:
    void SetUp() override {
        if (!canSampleFrames()) GTEST_SKIP() << "this processor has no AVX2";
    }
};

// Noise, or one value: `rowPixels` of it a row, of which the first `width` are the frame's.
struct Frame {
    Frame(int width, int height, int rowPixels, int value = -1)
        : bytes(static_cast<size_t>(rowPixels) * static_cast<size_t>(height) * 4), coded{bytes.data(), width,
                                                                                         height, rowPixels} {
        Random random(5);
        for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(value < 0 ? random.below(256) : value);
    }
    double at(int x, int y, int c) const {
        return bytes[static_cast<size_t>(4 * (y * coded.rowPixels + x) + c)];
    }

    std::vector<uint8_t> bytes;
    DisplayFrame coded;
};

double exact(const Frame& frame, const glm::dvec2& at, int c) {
    const int x = std::min(static_cast<int>(at.x), frame.coded.width - 2),
              y = std::min(static_cast<int>(at.y), frame.coded.height - 2);
    const double w = at.x - x, h = at.y - y;
    return (1 - h) * ((1 - w) * frame.at(x, y, c) + w * frame.at(x + 1, y, c)) +
           h * ((1 - w) * frame.at(x, y + 1, c) + w * frame.at(x + 1, y + 1, c));
}

constexpr int kStride = 48;

std::vector<uint32_t> sampled(const Frame& frame, const SampledCell& cell) {
    std::vector<uint32_t> picture(kStride * 40, 0xdeadbeef);
    sampleCell(frame.coded, cell, picture.data(), kStride);
    return picture;
}

// Any direction, any step, any width. Weights are eighths of a byte's last bit off, positions 1/65536 of a
// texel a pixel; noise makes the most of both.
TEST_F(FrameSampler, MixesTheFourTexelsAround) {
    const Frame frame(64, 40, 70);
    double worst = 0, sum = 0;
    int count = 0;
    for (const glm::vec2 right : {glm::vec2(0.45f, 0), glm::vec2(0.3f, 0.31f), glm::vec2(-0.5f, 0.2f),
                                  glm::vec2(1, 0), glm::vec2(0, -0.7f), glm::vec2(1.3f, 0.1f)})
        for (const int wide : {1, 7, 8, 25, 32}) {
            SampledCell cell{{3, 2}, {3 + wide, 11}, {0, 0}, right, {-right.y, right.x}};
            const glm::vec2 middle = 0.5f * (static_cast<float>(wide) * right + 9.0f * cell.up);
            cell.first = glm::vec2(31.7f, 19.2f) - middle;
            ASSERT_TRUE(isWithin(frame.coded, cell));
            const std::vector<uint32_t> picture = sampled(frame, cell);
            for (int y = cell.low.y; y < cell.high.y; ++y)
                for (int x = cell.low.x; x < cell.high.x; ++x)
                    for (int c = 0; c < 4; ++c) {
                        const glm::dvec2 at = glm::dvec2(cell.first) + (x - 3.0) * glm::dvec2(cell.right) +
                                              (y - 2.0) * glm::dvec2(cell.up);
                        const double is = picture[static_cast<size_t>(y * kStride + x)] >> (8 * c) & 255;
                        const double off = is - exact(frame, at, c);
                        worst = std::max(worst, std::abs(off));
                        sum += off;
                        ++count;
                    }
            EXPECT_EQ(picture[static_cast<size_t>(cell.high.y * kStride + 3)], 0xdeadbeef) << "the next row";
            EXPECT_EQ(picture[static_cast<size_t>(2 * kStride + 2)], 0xdeadbeef) << "left of it";
            EXPECT_EQ(picture[static_cast<size_t>(2 * kStride + 3 + wide)], 0xdeadbeef) << "right of it";
        }
    EXPECT_LT(worst, 1.6); // half a step of rounding, 1/255 of 255 of the weights
    EXPECT_LT(std::abs(sum / count), 0.15);
}

TEST_F(FrameSampler, LeavesWhatNeedsNoMixingAsItIs) {
    const Frame noise(64, 40, 64);
    const std::vector<uint32_t> copied = sampled(noise, {{0, 0}, {32, 32}, {5, 4}, {1, 0}, {0, 1}});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(copied[static_cast<size_t>(y * kStride + x)] >> (8 * c) & 255,
                          noise.at(x + 5, y + 4, c));
    for (const int value : {0, 1, 127, 128, 254, 255}) {
        const Frame even(64, 40, 64, value);
        for (const uint32_t pixel : sampled(even, {{0, 0}, {32, 8}, {8, 4}, {0.37f, 0.21f}, {-0.21f, 0.37f}}))
            ASSERT_TRUE(pixel == 0xdeadbeef || pixel == 0x01010101u * static_cast<uint32_t>(value)) << pixel;
    }
}

// Up to the last texel, and no further: the frame's memory ends there (the address sanitizer knows).
TEST_F(FrameSampler, ReadsNothingBesideTheFrame) {
    const Frame frame(64, 40, 64);
    const float x = 63 - 1 / 32.0f - 24 * 0.5f, y = 39 - 1 / 32.0f - 24 * 0.5f;
    for (const glm::vec2 first : {glm::vec2(1 / 32.0f), glm::vec2(x, y)}) {
        const SampledCell cell{{0, 0}, {25, 25}, first, {0.5f, 0}, {0, 0.5f}};
        ASSERT_TRUE(isWithin(frame.coded, cell));
        const std::vector<uint32_t> picture = sampled(frame, cell);
        EXPECT_NEAR(static_cast<double>(picture[24 * kStride + 24] & 255),
                    exact(frame, glm::dvec2(first) + 12.0, 0), 1.6);
    }
    EXPECT_FALSE(isWithin(frame.coded, {{0, 0}, {25, 25}, {x + 0.1f, y}, {0.5f, 0}, {0, 0.5f}}));
    EXPECT_FALSE(isWithin(frame.coded, {{0, 0}, {25, 25}, {-0.1f, 3}, {0.5f, 0}, {0, 0.5f}}));
    EXPECT_FALSE(isWithin(frame.coded, {{0, 0}, {25, 25}, {NAN, 3}, {0.5f, 0}, {0, 0.5f}}));
}

} // namespace
} // namespace shoal::render
