#include "engine/media/StereoView.h"

#include <opencv2/imgproc.hpp>

#include <cassert>
#include <cmath>

namespace shoal::media {

namespace {

// The brightness of a part of the frame, averaged over 32 x 32 cells. Each cell takes 8 x 8 samples, enough
// for telling halves apart and independent of the frame's size.
cv::Mat averageOf(const cv::Mat& frame, const cv::Rect& part) {
    constexpr int kCells = 32, kSamples = 8;
    cv::Mat samples, cells, brightness;
    cv::resize(frame(part), samples, {kCells * kSamples, kCells * kSamples}, 0, 0, cv::INTER_NEAREST);
    samples.convertTo(samples, CV_32F);
    cv::resize(samples, cells, {kCells, kCells}, 0, 0, cv::INTER_AREA);
    cv::transform(cells, brightness, cv::Matx13f(1 / 3.0f, 1 / 3.0f, 1 / 3.0f));
    return brightness;
}

// Mean absolute difference over the standard deviation of both together.
double difference(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat both;
    cv::hconcat(a, b, both);
    cv::Scalar mean, deviation;
    cv::meanStdDev(both, mean, deviation);
    // Below one level of brightness there is nothing to compare.
    if (deviation[0] < 1) return 1e9;
    return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total()) / deviation[0];
}

} // namespace

EyePart eyePart(Layout layout, int eye, int width, int height) {
    assert(layout != Layout::Auto && (eye == 0 || eye == 1));
    if (layout == Layout::TopBottom) return {0, eye * height / 2, width, height / 2};
    if (layout == Layout::LeftRight) return {eye * width / 2, 0, width / 2, height};
    return {0, 0, width, height};
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
    const cv::Mat view(h, w, CV_8UC3, const_cast<uint8_t*>(frame.pixels.data()));
    const auto apart = [&](const cv::Size& half) {
        return difference(averageOf(view, {{0, 0}, half}),
                          averageOf(view, {{w - half.width, h - half.height}, half}));
    };
    const double apartV = apart({w, h / 2}), apartH = apart({w / 2, h});
    if (apartV < kSameHalves && apartV <= apartH) return Layout::TopBottom;
    if (apartH < kSameHalves) return Layout::LeftRight;
    return Layout::Mono;
}

} // namespace shoal::media
