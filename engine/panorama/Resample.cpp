#include "engine/panorama/Resample.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::panorama {

namespace {

// Fractional mip level of each pixel.
cv::Mat levelOf(const cv::Mat& column, int levels) {
    cv::Mat level(column.size(), CV_32F);
    for (int y = 0; y < column.rows; ++y) {
        const float* at = column.ptr<float>(y);
        float* to = level.ptr<float>(y);
        for (int x = 0; x < column.cols; ++x) {
            const int left = std::max(x - 1, 0), right = std::min(x + 1, column.cols - 1);
            const float step = (at[right] - at[left]) / static_cast<float>(std::max(1, right - left));
            to[x] =
                std::clamp(std::log2(std::max(std::abs(step), 1.0f)), 0.0f, static_cast<float>(levels - 1));
        }
    }
    return level;
}

} // namespace

std::vector<cv::Mat> widthPyramid(const cv::Mat& photo) {
    std::vector<cv::Mat> levels{photo};
    while (levels.back().cols >= 8) {
        cv::Mat half;
        cv::resize(levels.back(), half, {levels.back().cols / 2, photo.rows}, 0, 0, cv::INTER_AREA);
        levels.push_back(half);
    }
    return levels;
}

cv::Mat resample(const std::vector<cv::Mat>& levels, const cv::Mat& column, const cv::Mat& row) {
    const cv::Mat level = levelOf(column, static_cast<int>(levels.size()));
    double minimum = 0, maximum = 0;
    cv::minMaxLoc(level, &minimum, &maximum);
    cv::Mat out = cv::Mat::zeros(column.size(), CV_32FC3);
    const cv::Mat rows = row - 0.5;
    for (int k = static_cast<int>(minimum); k <= static_cast<int>(std::ceil(maximum)); ++k) {
        const cv::Mat& from = levels[static_cast<size_t>(k)];
        const cv::Mat columns = column * (static_cast<double>(from.cols) / levels[0].cols) - 0.5;
        cv::Mat read;
        cv::remap(from, read, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
        for (int y = 0; y < out.rows; ++y) {
            const float* at = level.ptr<float>(y);
            for (int x = 0; x < out.cols; ++x) {
                const float share = std::max(0.0f, 1 - std::abs(at[x] - static_cast<float>(k)));
                if (share > 0) out.at<cv::Vec3f>(y, x) += share * read.at<cv::Vec3f>(y, x);
            }
        }
    }
    // A cubic kernel overshoots at edges; beside a sun that would be brighter than the sun.
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(levels[0].reshape(1), &darkest, &brightest);
    return cv::min(cv::max(out, darkest), brightest);
}

} // namespace shoal::panorama
