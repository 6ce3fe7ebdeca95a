#include "engine/camera/Glare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shoal::camera {

namespace {

constexpr int kSamples = 4; // samples of a cell in each direction
constexpr int kPasses = 4;  // of means over 3 cells; variance 8/3 + 1/12 cells^2, (4.7 degrees)^2
constexpr float kBright =
    0.05f; // least light around a cell: a few percent of it still exceed noise, toe and black level
constexpr double kDarkest = 0.002; // quantile; texels below it are undershoots of sharpening
constexpr size_t kFewCells = 100;

void readCells(const light::FrameView& frame, ImageRgbF& out) {
    constexpr int kDown = kGlowHeight * kSamples, kAcross = kGlowWidth * kSamples;
    constexpr float kShare = 1.0f / (kSamples * kSamples);
    std::ranges::fill(out.pixels, 0.0f);
    for (int j = 0; j < kDown; ++j) {
        const uint8_t* row =
            frame.pixels + static_cast<ptrdiff_t>((2 * j + 1) * frame.height / (2 * kDown)) * frame.rowStride;
        for (int i = 0; i < kAcross; ++i) {
            const uint8_t* texel = row + ptrdiff_t{3} * ((2 * i + 1) * frame.width / (2 * kAcross));
            float* to = out.at(i / kSamples, j / kSamples);
            for (int c = 0; c < 3; ++c) {
                const int value = texel[frame.bgr ? 2 - c : c];
                to[c] += kShare * (static_cast<float>(value * value) / (255.0f * 255.0f));
            }
        }
    }
}

// Averages over three cells down and as many across as are equally wide on the sphere.
void spread(ImageRgbF& map, ImageRgbF& across) {
    for (int y = 0; y < kGlowHeight; ++y) {
        const float ring = std::sin((static_cast<float>(y) + 0.5f) / kGlowHeight * std::numbers::pi_v<float>);
        const int reach = std::min(static_cast<int>(1 / ring + 0.5f), kGlowWidth / 2 - 1);
        const float share = 1 / static_cast<float>(2 * reach + 1);
        const auto at = [&](int x) { return map.at((x + kGlowWidth) % kGlowWidth, y); };
        std::array<float, 3> sum{};
        for (int i = -reach; i <= reach; ++i)
            for (size_t c = 0; c < 3; ++c) sum[c] += at(i)[c];
        for (int x = 0; x < kGlowWidth; ++x)
            for (size_t c = 0; c < 3; ++c) {
                across.at(x, y)[c] = std::max(sum[c], 0.0f) * share;
                sum[c] += at(x + reach + 1)[c] - at(x - reach)[c];
            }
    }
    for (int y = 0; y < kGlowHeight; ++y) {
        const int up = std::max(y - 1, 0), down = std::min(y + 1, kGlowHeight - 1);
        for (int x = 0; x < kGlowWidth; ++x)
            for (int c = 0; c < 3; ++c)
                map.at(x, y)[c] = (across.at(x, up)[c] + across.at(x, y)[c] + across.at(x, down)[c]) / 3;
    }
}

float luma(const float* c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

} // namespace

void GlareFilter::make(const light::FrameView& frame, Glare& out) {
    out.maxShare = 1;
    std::ranges::fill(out.spread.pixels, 0.0f);
    if (frame.width < 1 || frame.height < 1) return;
    readCells(frame, cells_);
    out.spread.pixels = cells_.pixels;
    for (int pass = 0; pass < kPasses; ++pass) spread(out.spread, across_);

    shares_.clear();
    for (int y = kGlowHeight / 8; y < kGlowHeight * 7 / 8; ++y)
        for (int x = 0; x < kGlowWidth; ++x)
            if (const float around = luma(out.spread.at(x, y)); around > kBright)
                shares_.push_back(luma(cells_.at(x, y)) / around);
    if (shares_.size() < kFewCells) return;
    const auto at = shares_.begin() + static_cast<ptrdiff_t>(kDarkest * static_cast<double>(shares_.size()));
    std::ranges::nth_element(shares_, at);
    out.maxShare = std::min(*at, 1.0f);
}

} // namespace shoal::camera
