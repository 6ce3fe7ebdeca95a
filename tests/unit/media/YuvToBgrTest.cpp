#include "engine/media/PictureDecoder.h"

#include "engine/core/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace shoal::media {
namespace {

// BT.601, BT.709 and BT.2020 alike, item 3, with the ranges of item 4 (8 bits).
std::array<double, 3> bgrOf(int luma, int cb, int cr, Luma k, bool full) {
    const double y = full ? luma : (luma - 16) * 255.0 / 219;
    const double range = full ? 1 : 255.0 / 224;
    const double r = y + (2 - 2 * k.red) * (cr - 128) * range, b = y + (2 - 2 * k.blue) * (cb - 128) * range;
    return {b, (y - k.red * r - k.blue * b) / (1 - k.red - k.blue), r};
}

// Rounding to a level takes 1/2; each of three products 1/64; luma's factor, in 2^13, half of that 239 times;
// two factors of differences, in 2^12, half of that 128 times.
constexpr double kTolerance = 0.5 + 3.0 / 64 + 239.0 / (1 << 14) + 2 * 128.0 / (1 << 13);

TEST(YuvToBgr, IsTheFormulaRounded) {
    std::vector<uint8_t> luma(512), cb(256), cr(256);
    ImageRgb8 image(512, 1);
    const std::vector<uint8_t>& bgr = image.pixels;
    for (size_t i = 0; i < 512; ++i) luma[i] = static_cast<uint8_t>(i / 2);
    for (const ColourMatrix matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709, ColourMatrix::Bt2020})
        for (const bool full : {false, true})
            for (int differences = 0; differences < 256 * 256; differences += 61) {
                std::ranges::fill(cb, static_cast<uint8_t>(differences >> 8));
                std::ranges::fill(cr, static_cast<uint8_t>(differences));
                toBgr({{luma.data(), cb.data(), cr.data()}, {}, 1, matrix, full}, image);
                for (size_t i = 0; i < 512; ++i) {
                    const auto wanted = bgrOf(luma[i], cb[0], cr[0], lumaOf(matrix), full);
                    for (size_t c = 0; c < 3; ++c)
                        ASSERT_NEAR(bgr[3 * i + c], std::clamp(wanted[c], 0.0, 255.0), kTolerance)
                            << nameOf(matrix) << ' ' << full << ' ' << i << ' ' << differences << ' ' << c;
                }
            }
}

// Rows of every width, without alignment.
TEST(YuvToBgr, EveryWidthIsTheSameToTheLastPixel) {
    Random random(5);
    std::vector<uint8_t> luma(130), cb(65), cr(65);
    for (auto* plane : {&luma, &cb, &cr})
        for (uint8_t& value : *plane) value = static_cast<uint8_t>(random.below(256));
    const auto converted = [](const auto& y, const auto& b, const auto& r, int width) {
        ImageRgb8 bgr(width, 1);
        toBgr({{y.data(), b.data(), r.data()}, {}, 1, ColourMatrix::Bt709, false}, bgr);
        return bgr.pixels;
    };
    const std::vector<uint8_t> whole = converted(luma, cb, cr, 130);
    for (int width = 1; width <= 129; ++width) {
        // The planes end with the row, so that reading beyond shows where reads are watched.
        const std::vector<uint8_t> y(luma.begin(), luma.begin() + width);
        const std::vector<uint8_t> b(cb.begin(), cb.begin() + (width + 1) / 2);
        const std::vector<uint8_t> r(cr.begin(), cr.begin() + (width + 1) / 2);
        const std::vector<uint8_t> part = converted(y, b, r, width);
        EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin())) << width;
    }
}

} // namespace
} // namespace shoal::media
