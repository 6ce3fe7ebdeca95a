// Reading a photo through a map that shrinks some of its parts and stretches others.
#pragma once

#include <opencv2/core.hpp>

#include <vector>

namespace shoal::panorama {

// The photo, half as wide from level to level; 3 floats. Heights are all the same: see sample().
std::vector<cv::Mat> widthLevels(const cv::Mat& photo);

// out(x, y) = photo at column(x, y), row(x, y), both in pixels of level 0 with the middle of the first at
// 0.5. Across, each pixel takes about as much of the photo as lies between it and its neighbour, between two
// levels; down, rows are taken to lie about one apart. Beyond the edges the last pixel repeats. Within
// the photo's own range.
cv::Mat sample(const std::vector<cv::Mat>& levels, const cv::Mat& column, const cv::Mat& row);

} // namespace shoal::panorama
