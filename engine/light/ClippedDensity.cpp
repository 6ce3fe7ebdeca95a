#include "engine/light/ClippedDensity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

constexpr int kColumns = 256;

// The mean over 2 radius + 1 values of a row that is closed.
void blurRow(const float* in, size_t count, size_t radius, float* out) {
    const size_t window = 2 * radius + 1;
    float sum = 0;
    for (size_t i = 0; i < window; ++i) sum += in[(count - radius % count + i) % count];
    for (size_t x = 0; x < count; ++x) {
        out[x] = std::max(0.0f, sum) / static_cast<float>(window);
        sum += in[(x + radius + 1) % count] - in[(x + count - radius % count) % count];
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
        sums_.resize(columns_ * rows_), density_.resize(sums_.size()), across_.resize(sums_.size());
        counts_.resize(rows_);
    }
    std::ranges::fill(sums_, 0.0f);
    std::ranges::fill(counts_, 0);
}

void ClippedDensity::addRow(int y, const float* clipped) {
    const size_t row = cellRow(y);
    ++counts_[row];
    float* sums = &sums_[row * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) sums[x] += clipped[i];
}

void ClippedDensity::finish() {
    std::ranges::fill(across_, 0.0f);
    for (size_t y = 0; y < rows_ && counts_[y] > 0; ++y) {
        float* sums = &sums_[y * columns_];
        if (std::all_of(sums, sums + columns_, [](float sum) { return sum == 0; })) continue;
        for (size_t x = 0; x < columns_; ++x)
            sums[x] /= static_cast<float>(counts_[y] * (starts_[x + 1] - starts_[x]));
        const double ring =
            std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(rows_));
        const auto radius = static_cast<size_t>(std::lround(1 / ring));
        blurRow(sums, columns_, std::min(radius, (columns_ - 1) / 2), &across_[y * columns_]);
    }
    for (size_t y = 0; y < rows_ && counts_[y] > 0; ++y) {
        const float* above = &across_[(y ? y - 1 : 0) * columns_];
        const float* here = &across_[y * columns_];
        const float* below = &across_[std::min(y + 1, rows_ - 1) * columns_];
        for (size_t x = 0; x < columns_; ++x)
            density_[y * columns_ + x] = (above[x] + here[x] + below[x]) / 3;
    }
}

void ClippedDensity::weigh(int y, float* clipped) const {
    const float* density = &density_[cellRow(y) * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) clipped[i] *= density[x];
}

} // namespace shoal::light
