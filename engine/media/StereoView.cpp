#include "engine/media/StereoView.h"

#include <array>
#include <cassert>
#include <cmath>

namespace shoal::media {

namespace {

constexpr int kCells = 32;
using Cells = std::array<double, kCells * kCells>;

// Means of the brightness in kCells x kCells cells of a part of the frame. Each cell takes at most 8 x 8
// samples, enough for telling halves apart and independent of the frame's size.
Cells averageOf(const ImageRgb8& frame, int left, int top, int width, int height) {
    constexpr int kSamples = 8;
    Cells cells{};
    for (int i = 0; i < kCells * kSamples; ++i) {
        const int y = top + static_cast<int>(int64_t{i} * height / (kCells * kSamples));
        for (int j = 0; j < kCells * kSamples; ++j) {
            const uint8_t* p = frame.at(left + static_cast<int>(int64_t{j} * width / (kCells * kSamples)), y);
            cells[static_cast<size_t>(i / kSamples * kCells + j / kSamples)] += p[0] + p[1] + p[2];
        }
    }
    return cells;
}

// Mean absolute difference over the standard deviation of both together.
double difference(const Cells& a, const Cells& b) {
    double sum = 0, squares = 0, apart = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += a[i] + b[i];
        squares += a[i] * a[i] + b[i] * b[i];
        apart += std::abs(a[i] - b[i]);
    }
    const double n = 2.0 * static_cast<double>(a.size());
    const double variance = squares / n - sum / n * (sum / n);
    // Below one level of brightness per sample (192 samples a cell) there is nothing to compare.
    if (variance < 192.0 * 192.0) return 1e9;
    return apart / static_cast<double>(a.size()) / std::sqrt(variance);
}

} // namespace

EyeView eyeView(Layout layout, int eye) {
    assert(layout != Layout::Auto && (eye == 0 || eye == 1));
    const float second = eye == 1 ? 0.5f : 0.0f;
    if (layout == Layout::TopBottom) return {{0, second}, {1, 0.5f}};
    if (layout == Layout::LeftRight) return {{second, 0}, {0.5f, 1}};
    return {};
}

Layout layoutFromShape(int width, int height) {
    const double aspect = static_cast<double>(width) / height;
    const auto near = [&](double wanted) { return std::abs(aspect / wanted - 1) < 0.06; };
    if (near(2)) return Layout::Mono;
    if (near(1)) return Layout::TopBottom;
    if (near(4)) return Layout::LeftRight;
    return Layout::Auto;
}

Layout layoutFromContent(const ImageRgb8& frame) {
    const int w = frame.width, h = frame.height;
    if (w < 2 || h < 2) return Layout::Mono;
    const double apartV =
        difference(averageOf(frame, 0, 0, w, h / 2), averageOf(frame, 0, h - h / 2, w, h / 2));
    const double apartH =
        difference(averageOf(frame, 0, 0, w / 2, h), averageOf(frame, w - w / 2, 0, w / 2, h));
    if (apartV < kSameHalves && apartV <= apartH) return Layout::TopBottom;
    if (apartH < kSameHalves) return Layout::LeftRight;
    return Layout::Mono;
}

} // namespace shoal::media
