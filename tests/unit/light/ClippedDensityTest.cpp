#include "engine/light/ClippedLight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace shoal::light {
namespace {

// A cell is 4 x 4 pixels.
constexpr int kFrameWidth = 1024, kFrameHeight = 512, kAbove = kFrameHeight / 2;

class UpperHalf {
  public:
    float& at(int x, int y) { return rows_[static_cast<size_t>(y)][static_cast<size_t>(x)]; }
    // The values times their densities.
    UpperHalf weighed() const {
        ClippedDensity density;
        const UpperHalf before = filled(); // of which nothing is left
        for (const UpperHalf* frame : {&before, this}) {
            density.begin(kFrameWidth, kFrameHeight);
            for (int y = 0; y < kAbove; ++y) density.addRow(y, frame->rows_[static_cast<size_t>(y)].data());
            density.finish();
        }
        UpperHalf out = *this;
        for (int y = 0; y < kAbove; ++y) density.weigh(y, out.rows_[static_cast<size_t>(y)].data());
        return out;
    }
    static UpperHalf filled() {
        UpperHalf frame;
        for (auto& row : frame.rows_) row.assign(kFrameWidth, 1);
        return frame;
    }

  private:
    std::vector<std::vector<float>> rows_ = std::vector(kAbove, std::vector<float>(kFrameWidth));
};

// Returns the number of cells of a neighbourhood at the elevation of a row.
float cellsAround(int y) {
    const double ring = std::sin(std::numbers::pi * (y / 4 + 0.5) / (kFrameHeight / 4));
    return 3 * (2 * static_cast<float>(std::lround(1 / ring)) + 1);
}

TEST(ClippedDensity, IsOneInsideAndLessAtTheHorizon) {
    UpperHalf weighed = UpperHalf::filled().weighed();
    for (int y = 0; y < kAbove; y += 3)
        for (int x = 0; x < kFrameWidth; x += 7)
            ASSERT_NEAR(weighed.at(x, y), y < kAbove - 4 ? 1 : 2 / 3.0f, 1e-5) << x << ' ' << y;
}

TEST(ClippedDensity, OneCellCountsItsShareOfTheCellsAround) {
    for (const int y : {8, 40, 128, 240})       // 3 to 84 degrees from the zenith
        for (const int x : {0, 4, 512, 1020}) { // over the seam too
            UpperHalf frame;
            for (int dy = 0; dy < 4; ++dy)
                for (int dx = 0; dx < 4; ++dx) frame.at(x + dx, y + dy) = 1;
            UpperHalf weighed = frame.weighed();
            EXPECT_NEAR(weighed.at(x + 1, y + 2), 1 / cellsAround(y), 1e-6) << x << ' ' << y;
            EXPECT_EQ(weighed.at((x + 4) % kFrameWidth, y), 0);
        }
}

// A glint of a pixel or a lamp of a degree moves a pixel at a time without a flicker.
TEST(ClippedDensity, StaysWhileSomethingSmallMoves) {
    for (int x = 0; x < 12; ++x) {
        UpperHalf frame;
        frame.at(kFrameWidth - 6 + x - (x < 6 ? 0 : kFrameWidth), 160 + x) = 1;
        EXPECT_NEAR(frame.weighed().at(kFrameWidth - 6 + x - (x < 6 ? 0 : kFrameWidth), 160 + x),
                    1 / 16.0f / cellsAround(160), 1e-7);
    }
}

TEST(ClippedDensity, TakesFramesOfAnySize) {
    for (const auto& [width, height] : {std::pair(2, 1), {3, 2}, {5, 7}, {300, 150}, {700, 351}}) {
        ClippedDensity density;
        density.begin(width, height);
        std::vector<float> row(static_cast<size_t>(width), 1);
        const int above = (height + 1) / 2;
        for (int y = 0; y < above; ++y) density.addRow(y, row.data());
        density.finish();
        density.weigh(0, row.data());
        for (const float each : row) {
            EXPECT_GT(each, 0) << width;
            EXPECT_LE(each, 1.0001f) << width;
        }
    }
}

} // namespace
} // namespace shoal::light
