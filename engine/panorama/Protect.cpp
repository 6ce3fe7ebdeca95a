#include "engine/panorama/Protect.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::panorama {

namespace {

constexpr double kClosed = 10;      // more than any pixel can differ from its neighbour
constexpr double kUpright = 4;      // times the edge's own step
constexpr double kStructure = 0.25; // times the gradient around

} // namespace

Plane protect(const Colours& picture, const Strip& strip) {
    const cv::Mat colours(picture.height, picture.width, CV_32FC3, const_cast<float*>(picture.pixels.data()));
    cv::Mat grey, across, down, upright;
    cv::cvtColor(colours, grey, cv::COLOR_RGB2GRAY);
    const cv::Matx13f between(-0.5f, 0, 0.5f);
    cv::filter2D(grey, across, CV_32F, between, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::filter2D(grey, down, CV_32F, between.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);

    // Steps of one sign add up along an upright edge; those of texture cancel.
    cv::boxFilter(across, upright, CV_32F, {1, std::max(1, picture.height / 4)}, {-1, -1}, true,
                  cv::BORDER_REPLICATE);
    upright = cv::abs(upright);
    // What stands between two edges close together, such as a post, goes with them.
    const int close = std::max(3, picture.width / 32) | 1;
    cv::morphologyEx(upright, upright, cv::MORPH_CLOSE, cv::Mat::ones(1, close, CV_8U));
    cv::dilate(upright, upright, cv::Mat::ones(1, 3, CV_8U));

    cv::Mat structure = cv::abs(across) + cv::abs(down);
    cv::GaussianBlur(structure, structure, {}, std::max(0.5, picture.width / 120.0), 0, cv::BORDER_REPLICATE);

    Plane weight(picture.width, picture.height);
    cv::Mat out(picture.height, picture.width, CV_32F, weight.pixels.data());
    cv::Mat(kUpright * upright + kStructure * structure).copyTo(out);
    const double usual = cv::mean(out)[0] + 1e-3;
    for (int x = 0; x < picture.width; ++x) {
        const double beyond = std::abs(x + 0.5 - strip.middle) - strip.half;
        const double near = strip.fade > 0 ? std::clamp(1 - beyond / strip.fade, 0.0, 1.0) : 0.0;
        out.col(x) += beyond <= 0 ? kClosed : 4 * usual * near * near;
    }
    return weight;
}

} // namespace shoal::panorama
