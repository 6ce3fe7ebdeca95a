#include "content/make/depth/StereoDepth.h"

#include "content/make/depth/GreyFilm.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::depth {

namespace {

constexpr int kMaxWidth = 2048;
constexpr float kMinContrast = 1.5f; // grey values, as in CubeFlow

} // namespace

struct StereoDepth::Impl {
    cv::Ptr<cv::DISOpticalFlow> flow = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
    cv::Mat1b left, right;
    cv::Mat2f there, back;
};

StereoDepth::StereoDepth() : impl_(makeHidden<Impl>()) {}

void StereoDepth::estimate(const light::FrameView& left, const light::FrameView& right, double baseline_m,
                           int width, DepthEstimate& out) {
    const int wide = std::min(left.width, kMaxWidth) / 4 * 4, padding = wide / 16;
    Impl& own = *impl_;
    greyOf(left, wide, padding, own.left), greyOf(right, wide, padding, own.right);
    own.there.release(), own.back.release(); // else the flow would start from their values
    own.flow->calc(own.left, own.right, own.there);
    own.flow->calc(own.right, own.left, own.back);
    const int height = width / 2;
    out.inverse.assign(static_cast<size_t>(width) * height, 0);
    out.confidence.assign(out.inverse.size(), 0);
    const float scale = static_cast<float>(wide) / static_cast<float>(width);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int px = static_cast<int>((static_cast<float>(x) + 0.5f) * scale) + padding;
            const int py = static_cast<int>((static_cast<float>(y) + 0.5f) * scale);
            const cv::Vec2f by = own.there(py, px);
            const int qx = px + static_cast<int>(std::lround(by[0])),
                      qy = std::clamp(py + static_cast<int>(std::lround(by[1])), 0, own.back.rows - 1);
            if (qx < 0 || qx >= own.back.cols) continue;
            // Both eyes move on a circle and look along its tangents (Peleg and Ben-Ezra 1999): the left eye
            // sees a near point farther to the right, by 2 asin(baseline / 2 / horizontal distance).
            const double disparity_rad = -static_cast<double>(by[0]) * 2 * std::numbers::pi / wide;
            const double latitude = (0.5 - (y + 0.5) / height) * std::numbers::pi;
            const size_t i = static_cast<size_t>(y) * width + x;
            out.inverse[i] = static_cast<float>(std::max(2 * std::sin(disparity_rad / 2) / baseline_m, 0.0) *
                                                std::cos(latitude));
            const cv::Rect window(std::clamp(px - 4, 0, own.left.cols - 9),
                                  std::clamp(py - 4, 0, own.left.rows - 9), 9, 9);
            cv::Scalar mean, deviation;
            cv::meanStdDev(own.left(window), mean, deviation);
            if (deviation[0] < static_cast<double>(kMinContrast)) continue;
            const double error = 0.1 + cv::norm(by + own.back(qy, qx)) + std::abs(by[1]); // pixels
            const double relative = error / std::max(-static_cast<double>(by[0]), 0.1);
            // Near a pole rows are stretched, and all their directions are one: disparity cannot be measured.
            const double atPole = std::clamp((std::cos(latitude) - 0.35) / 0.25, 0.0, 1.0);
            out.confidence[i] = static_cast<float>(atPole * std::clamp(1.2 - 4 * relative, 0.0, 1.0));
        }
}

} // namespace shoal::depth
