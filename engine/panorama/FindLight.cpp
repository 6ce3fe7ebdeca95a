#include "engine/panorama/FindLight.h"

#include "engine/light/InverseToneMap.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::panorama {

MainLight findMainLight(const cv::Mat& photo) {
    constexpr int kMaxWidth = 1024, kMinSide = 8;
    cv::Mat small = photo;
    if (photo.cols > kMaxWidth)
        cv::resize(photo, small, {kMaxWidth, std::max(kMinSide, photo.rows * kMaxWidth / photo.cols)}, 0, 0,
                   cv::INTER_AREA);
    cv::Mat radiance(small.size(), CV_32F), spread;
    std::transform(small.begin<cv::Vec3f>(), small.end<cv::Vec3f>(), radiance.begin<float>(),
                   [](const cv::Vec3f& c) {
                       return light::thesisLuminance(light::radianceFromDisplay({c[0], c[1], c[2]}));
                   });
    cv::GaussianBlur(radiance, spread, {}, std::max(0.5, small.cols * 0.01), 0, cv::BORDER_REPLICATE);
    double maximum = 0;
    cv::Point peak;
    cv::minMaxLoc(spread, nullptr, &maximum, nullptr, &peak);

    cv::Mat spot, labels, numbers, centres;
    cv::bitwise_or(radiance > 0.8 * maximum, spread >= maximum, spot); // the peak itself, whatever lies there
    cv::connectedComponentsWithStats(spot, labels, numbers, centres, 8, CV_32S);
    const int mine = labels.at<int>(peak);
    cv::Mat weight(small.size(), CV_32F, cv::Scalar(0));
    cv::add(radiance, 1e-9, weight, labels == mine);
    const cv::Moments sums = cv::moments(weight);
    const cv::Point2d scale(static_cast<double>(photo.cols) / small.cols,
                            static_cast<double>(photo.rows) / small.rows);
    return {{(sums.m10 / sums.m00 + 0.5) * scale.x, (sums.m01 / sums.m00 + 0.5) * scale.y},
            std::sqrt(numbers.at<int>(mine, cv::CC_STAT_AREA) / std::numbers::pi) * scale.x};
}

} // namespace shoal::panorama
