#include "engine/panorama/FindLight.h"

#include "engine/light/InverseToneMap.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <numbers>

namespace shoal::panorama {

MainLight findMainLight(const cv::Mat& photo) {
    cv::Mat radiance(photo.size(), CV_32F);
    for (int y = 0; y < photo.rows; ++y)
        for (int x = 0; x < photo.cols; ++x) {
            const auto& c = photo.at<cv::Vec3f>(y, x);
            radiance.at<float>(y, x) = light::thesisLuminance(light::radianceFromDisplay({c[0], c[1], c[2]}));
        }
    cv::Mat spread;
    cv::GaussianBlur(radiance, spread, {}, std::max(0.5, photo.cols * 0.01), 0, cv::BORDER_REPLICATE);
    double maximum = 0;
    cv::Point peak;
    cv::minMaxLoc(spread, nullptr, &maximum, nullptr, &peak);

    cv::Mat spot, labels, numbers, centres;
    cv::bitwise_or(radiance > 0.8 * maximum, spread >= maximum, spot); // the peak itself, whatever lies there
    cv::connectedComponentsWithStats(spot, labels, numbers, centres, 8, CV_32S);
    const int mine = labels.at<int>(peak);
    double sum = 0, sumX = 0, sumY = 0;
    for (int y = 0; y < radiance.rows; ++y)
        for (int x = 0; x < radiance.cols; ++x) {
            if (labels.at<int>(y, x) != mine) continue;
            const double weight = static_cast<double>(radiance.at<float>(y, x)) + 1e-9;
            sum += weight;
            sumX += weight * (x + 0.5);
            sumY += weight * (y + 0.5);
        }
    return {{sumX / sum, sumY / sum}, std::sqrt(numbers.at<int>(mine, cv::CC_STAT_AREA) / std::numbers::pi)};
}

} // namespace shoal::panorama
