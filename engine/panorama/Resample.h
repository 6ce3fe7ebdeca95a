// Filtered resampling of a photo through a map that minifies horizontally by varying factors.
#pragma once

#include <opencv2/core.hpp>

#include <vector>

namespace shoal::panorama {

// Mip levels of the photo (3 floats), each half as wide as the last and of the same height.
std::vector<cv::Mat> widthPyramid(const cv::Mat& photo);

// out(x, y) = photo at column(x, y), row(x, y), both in pixels of level 0 with the middle of the first at
// 0.5. Horizontally filtered between two levels by the distance of neighbouring columns; vertically rows are
// taken to be about one apart. Beyond the edges the last pixel repeats. Within the photo's own range.
cv::Mat resample(const std::vector<cv::Mat>& levels, const cv::Mat& column, const cv::Mat& row);

} // namespace shoal::panorama
