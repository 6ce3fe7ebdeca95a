#include "engine/core/Random.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/software/FrameSampler.h"
#include "engine/render/software/SmoothOutlines.h"
#include "tests/Test.h"
#include "tests/unit/depth/MadeMap.h"

namespace shoal::render {
namespace {

constexpr glm::ivec2 kSize(640, 480);

View ahead() { return {.verticalFov = 1.2f, .aspect = static_cast<float>(kSize.x) / kSize.y}; }

// Returns a map of a wall that is 1 m ahead to the left of the middle and 4 m ahead to the right of it.
depth::DepthMap step() {
    return depth::mapOf([](const glm::vec3& d) { return std::max(-d.z, 0.0f) / (d.x < 0 ? 1.0f : 4.0f); });
}

TEST(BackgroundCells, CoverEveryPixelOnceAlsoWhereTheyAreDivided) {
    const depth::DepthMap map = step();
    BackgroundCells whole, divided;
    whole.make(ahead(), glm::mat3(1), kSize);
    divided.make(ahead(), glm::mat3(1), kSize, {&map, {0.1f, 0, 0}});
    EXPECT_GT(divided.all().size(), whole.all().size());
    for (const BackgroundCells* cells : {&whole, &divided}) {
        std::vector<int> covered(static_cast<size_t>(kSize.x) * kSize.y, 0);
        for (const BackgroundCell& cell : cells->all())
            for (int y = cell.low.y; y < cell.high.y; ++y)
                for (int x = cell.low.x; x < cell.high.x; ++x)
                    ++covered[static_cast<size_t>(y) * kSize.x + x];
        EXPECT_EQ(std::ranges::count(covered, 1), static_cast<ptrdiff_t>(covered.size()));
    }
}

// Away from the step, what a cell says of its pixels is where a ray from the eye meets the walls. Half a
// texel of a 2048 wide video for a cell that was not divided, as much for the search, and steps of codes.
TEST(BackgroundCells, ShowWhatAnEyeBesideTheCameraSees) {
    const depth::DepthMap map = step();
    const glm::vec3 eye(0.1f, 0.02f, 0);
    BackgroundCells cells;
    cells.make(ahead(), glm::mat3(1), kSize, {&map, eye});
    int compared = 0;
    for (const BackgroundCell& cell : cells.all()) {
        if (cell.polar) continue;
        const glm::vec2 pixel = 0.5f * glm::vec2(cell.low + cell.high);
        const glm::vec2 plane = (2.0f * pixel / glm::vec2(kSize) - 1.0f) * ahead().halfExtent();
        if (plane.x > -0.2f && plane.x < 0.1f) continue; // where the eye sees past the step
        const float away = plane.x < 0 ? 1.0f : 4.0f;
        const glm::vec2 right = latLongFromDirection(glm::normalize(eye + glm::vec3(plane, -1) * away));
        const glm::vec2 shown = cell.first + 0.5f * (cell.right + cell.up);
        EXPECT_LT(glm::length((shown - right) * glm::vec2(2048, 1024)), 1.3f);
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

// A cell across the step would draw the film between its two sides out by 24 texels, and show it twice. A
// pixel is at most 1.1 texels wide here, and a wall that is seen from aside a little more.
TEST(BackgroundCells, DrawNothingOutOverAnEdge) {
    const depth::DepthMap map = step();
    for (const float aside_m : {-0.1f, 0.1f}) {
        BackgroundCells cells;
        cells.make(ahead(), glm::mat3(1), kSize, {&map, {aside_m, 0, 0}});
        for (const BackgroundCell& cell : cells.all()) {
            if (cell.polar) continue;
            const auto pixels = glm::vec2(cell.high - cell.low);
            constexpr glm::vec2 kTexels(2048, 1024);
            EXPECT_LT(glm::length(cell.right * kTexels), 1.3f * pixels.x + 3)
                << cell.low.x << ", " << cell.low.y;
            EXPECT_LT(glm::length(cell.up * kTexels), 1.3f * pixels.y + 3)
                << cell.low.x << ", " << cell.low.y;
        }
    }
}

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

// Outlines drawn with one sample a pixel, against how much of each pixel they cover.

constexpr glm::ivec2 kPictureSize(96, 64);
constexpr uint32_t kSolid = 0xff4080c0; // premultiplied

using Inside = std::function<bool(double x, double y)>;

std::vector<uint32_t> drawn(const Inside& inside) {
    std::vector<uint32_t> pixels;
    for (int y = 0; y < kPictureSize.y; ++y)
        for (int x = 0; x < kPictureSize.x; ++x) pixels.push_back(inside(x + 0.5, y + 0.5) ? kSolid : 0);
    return pixels;
}

double coverage(const Inside& inside, int x, int y) {
    constexpr int kParts = 16;
    int count = 0;
    for (int j = 0; j < kParts; ++j)
        for (int i = 0; i < kParts; ++i) count += inside(x + (i + 0.5) / kParts, y + (j + 0.5) / kParts);
    return static_cast<double>(count) / (kParts * kParts);
}

void smooth(std::vector<uint32_t>& pixels, const glm::ivec2& size = kPictureSize) {
    ChangedPixels changed;
    smoothOutlines(pixels, size, changed, [](const glm::ivec2&, const glm::ivec2&) { return true; });
}

// Root mean square of alpha less coverage, over pixels of the outline away from the picture's edges.
double error(const std::vector<uint32_t>& pixels, const Inside& inside) {
    double sum = 0;
    int count = 0;
    for (int y = 16; y < kPictureSize.y - 16; ++y)
        for (int x = 26; x < kPictureSize.x - 26; ++x) {
            const double exact = coverage(inside, x, y);
            if (exact == 0 || exact == 1) continue;
            const double off = (pixels[static_cast<size_t>(y * kPictureSize.x + x)] >> 24) / 255.0 - exact;
            sum += off * off;
            ++count;
        }
    return count ? std::sqrt(sum / count) : 0;
}

TEST(SmoothOutlines, HalfPlanesAreTheirCoverage) {
    double before = 0, after = 0;
    constexpr int kTurns = 72;
    for (int k = 0; k < kTurns; ++k) {
        const double turn = 2 * std::numbers::pi * (k + 0.3) / kTurns, a = std::cos(turn), b = std::sin(turn);
        const Inside inside = [&](double x, double y) { return a * (x - 47.7) + b * (y - 31.4) < 0; };
        std::vector<uint32_t> pixels = drawn(inside);
        before += error(pixels, inside) / kTurns;
        smooth(pixels);
        EXPECT_LT(error(pixels, inside), 0.17) << "turned by " << turn; // worst: diagonals
        after += error(pixels, inside) / kTurns;
    }
    EXPECT_NEAR(before, 1 / std::sqrt(12.0), 0.05); // of coverages that are about equally frequent
    EXPECT_LT(after, before / 2);
}

TEST(SmoothOutlines, DiscsAreNearerToTheirCoverage) {
    for (const double radius : {4.0, 9.0, 15.0}) {
        const Inside inside = [&](double x, double y) { return std::hypot(x - 48.2, y - 32.3) < radius; };
        std::vector<uint32_t> pixels = drawn(inside);
        const double before = error(pixels, inside);
        smooth(pixels);
        EXPECT_LT(error(pixels, inside), 0.75 * before) << radius;
    }
}

// Colours stay the object's own, premultiplied; a pixel that no outline touches stays as it is.
TEST(SmoothOutlines, ChangeNothingButCoverage) {
    const Inside inside = [](double x, double y) { return x + 0.3 * y < 60; };
    const std::vector<uint32_t> before = drawn(inside);
    std::vector<uint32_t> after = before;
    smooth(after);
    EXPECT_NE(after, before);
    for (size_t i = 0; i < after.size(); ++i) {
        const int x = static_cast<int>(i) % kPictureSize.x, y = static_cast<int>(i) / kPictureSize.x;
        if (std::abs(x + 0.3 * y - 60) > 3) {
            EXPECT_EQ(after[i], before[i]);
        }
        for (int shift = 0; shift < 24; shift += 8)
            EXPECT_NEAR(after[i] >> shift & 255, (kSolid >> shift & 255) * (after[i] >> 24) / 255.0, 1);
    }
}

TEST(SmoothOutlines, SoftOutlinesStay) {
    std::vector<uint32_t> pixels;
    for (int i = 0; i < kPictureSize.x * kPictureSize.y; ++i)
        pixels.push_back(static_cast<uint32_t>(2 * (i % kPictureSize.x)) << 24);
    const std::vector<uint32_t> before = pixels;
    smooth(pixels);
    EXPECT_EQ(pixels, before);
}

TEST(SmoothOutlines, PicturesOfAnySize) {
    for (const glm::ivec2 size :
         {glm::ivec2(0), glm::ivec2(1, 5), glm::ivec2(2), glm::ivec2(3), glm::ivec2(40, 3)}) {
        std::vector<uint32_t> pixels(static_cast<size_t>(size.x * size.y));
        for (size_t i = 0; i < pixels.size(); i += 2) pixels[i] = kSolid;
        smooth(pixels, size);
    }
}

} // namespace
} // namespace shoal::render
