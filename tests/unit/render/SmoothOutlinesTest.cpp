// Outlines drawn with one sample a pixel, against how much of each pixel they cover.
#include "engine/render/software/SmoothOutlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace shoal::render {
namespace {

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

// Root mean square of alpha less coverage, over pixels that the outline crosses, away from the edges of the
// picture.
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
        smoothOutlines(pixels, kPictureSize);
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
        smoothOutlines(pixels, kPictureSize);
        EXPECT_LT(error(pixels, inside), 0.75 * before) << radius;
    }
}

// Colours stay the object's own, premultiplied; a pixel that no outline touches stays as it is.
TEST(SmoothOutlines, ChangeNothingButCoverage) {
    const Inside inside = [](double x, double y) { return x + 0.3 * y < 60; };
    const std::vector<uint32_t> before = drawn(inside);
    std::vector<uint32_t> after = before;
    smoothOutlines(after, kPictureSize);
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
    smoothOutlines(pixels, kPictureSize);
    EXPECT_EQ(pixels, before);
}

TEST(SmoothOutlines, PicturesOfAnySize) {
    for (const glm::ivec2 size :
         {glm::ivec2(0), glm::ivec2(1, 5), glm::ivec2(2), glm::ivec2(3), glm::ivec2(40, 3)}) {
        std::vector<uint32_t> pixels(static_cast<size_t>(size.x * size.y));
        for (size_t i = 0; i < pixels.size(); i += 2) pixels[i] = kSolid;
        smoothOutlines(pixels, size);
    }
}

} // namespace
} // namespace shoal::render
