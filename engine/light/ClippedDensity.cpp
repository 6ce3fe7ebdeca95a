#include "engine/light/ClippedDensity.h"

#include "engine/light/Vectorise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

constexpr int kColumns = 256;

// Box-filters a circular row of `count` values: the mean of 2 radius + 1 values, at most `count`, for each.
void blurRow(const float* in, size_t count, size_t radius, float* out) {
    const size_t window = 2 * radius + 1;
    float sum = 0;
    for (size_t i = 0; i < window; ++i) sum += in[(count - radius + i) % count];
    size_t next = (radius + 1) % count, last = count - radius; // indices entering and leaving the window
    for (size_t x = 0; x < count; ++x) {
        out[x] = std::max(0.0f, sum) / static_cast<float>(window);
        sum += in[next] - in[last % count];
        next = next + 1 < count ? next + 1 : 0;
        last = last + 1 < count ? last + 1 : 0;
    }
}

} // namespace

void ClippedDensity::begin(int width, int height) {
    if (width != width_ || height != height_) {
        width_ = width, height_ = height;
        columns_ = static_cast<size_t>(std::min(width, kColumns));
        rows_ = static_cast<size_t>(std::min(height, kColumns / 2));
        starts_.clear();
        for (size_t x = 0; x <= columns_; ++x)
            starts_.push_back(static_cast<int>((x * static_cast<size_t>(width) + columns_ - 1) / columns_));
        sums_.assign(columns_ * rows_, 0), density_.resize(sums_.size()), across_.resize(sums_.size());
        counts_.resize(rows_), anything_.assign(rows_, false);
    }
    for (size_t y = 0; y < rows_; ++y)
        if (anything_[y]) std::fill_n(&sums_[y * columns_], columns_, 0.0f);
    std::ranges::fill(counts_, 0);
    std::ranges::fill(anything_, false);
}

void ClippedDensity::addRow(int y, const float* clipped) {
    const size_t row = cellRow(y);
    ++counts_[row];
    if (sumsOf<1>(clipped, static_cast<size_t>(width_))[0] == 0) return; // the usual case
    anything_[row] = true;
    float* sums = &sums_[row * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) sums[x] += clipped[i];
}

void ClippedDensity::finish() {
    for (size_t y = 0; y < rows_; ++y) {
        if (!anything_[y]) continue;
        float* sums = &sums_[y * columns_];
        for (size_t x = 0; x < columns_; ++x)
            sums[x] /= static_cast<float>(counts_[y] * (starts_[x + 1] - starts_[x]));
        const double ring =
            std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(rows_));
        const auto radius = static_cast<size_t>(std::lround(1 / ring));
        blurRow(sums, columns_, std::min(radius, (columns_ - 1) / 2), &across_[y * columns_]);
    }
    for (size_t y = 0; y < rows_; ++y) {
        if (!anything_[y]) continue; // without clipped pixels weigh() ignores the row
        float* density = &density_[y * columns_];
        std::fill_n(density, columns_, 0.0f);
        for (const size_t from : {y ? y - 1 : 0, y, std::min(y + 1, rows_ - 1)})
            for (size_t x = 0; anything_[from] && x < columns_; ++x)
                density[x] += across_[from * columns_ + x] / 3;
    }
}

void ClippedDensity::weigh(int y, float* clipped) const {
    const size_t row = cellRow(y);
    if (!anything_[row]) return;
    const float* density = &density_[row * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) clipped[i] *= density[x];
}

} // namespace shoal::light
