#include "engine/panorama/SeamWeights.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::panorama {

namespace {

constexpr double kProhibitive = 10; // more than any pixel can differ from its neighbour
constexpr double kVertical = 4;     // times the edge's own step
constexpr double kTexture = 0.25;   // times the local gradient

} // namespace

Plane seamWeights(const Colours& picture, const ProtectedColumns& columns) {
    const cv::Mat colours(picture.height, picture.width, CV_32FC3, const_cast<float*>(picture.pixels.data()));
    cv::Mat grey, across, down, vertical;
    cv::cvtColor(colours, grey, cv::COLOR_RGB2GRAY);
    const cv::Matx13f between(-0.5f, 0, 0.5f);
    cv::filter2D(grey, across, CV_32F, between, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::filter2D(grey, down, CV_32F, between.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);

    // Steps of one sign add up along a vertical edge; those of texture cancel.
    cv::boxFilter(across, vertical, CV_32F, {1, std::max(1, picture.height / 4)}, {-1, -1}, true,
                  cv::BORDER_REPLICATE);
    vertical = cv::abs(vertical);
    // The space between two close edges, such as a post, is protected with them.
    const int close = std::max(3, picture.width / 32) | 1;
    cv::morphologyEx(vertical, vertical, cv::MORPH_CLOSE, cv::Mat::ones(1, close, CV_8U));
    cv::dilate(vertical, vertical, cv::Mat::ones(1, 3, CV_8U));

    cv::Mat texture = cv::abs(across) + cv::abs(down);
    cv::GaussianBlur(texture, texture, {}, std::max(0.5, picture.width / 120.0), 0, cv::BORDER_REPLICATE);

    Plane weight(picture.width, picture.height);
    cv::Mat out(picture.height, picture.width, CV_32F, weight.pixels.data());
    cv::Mat(kVertical * vertical + kTexture * texture).copyTo(out);
    const double usual = cv::mean(out)[0] + 1e-3;
    for (int x = 0; x < picture.width; ++x) {
        const double beyond = std::abs(x + 0.5 - columns.middle) - columns.half;
        const double near = columns.fade > 0 ? std::clamp(1 - beyond / columns.fade, 0.0, 1.0) : 0.0;
        out.col(x) += beyond <= 0 ? kProhibitive : 4 * usual * near * near;
    }
    return weight;
}

} // namespace shoal::panorama
