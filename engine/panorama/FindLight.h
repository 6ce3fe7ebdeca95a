// Position and size of a photo's brightest light source.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

struct MainLight {
    cv::Point2d place; // pixels of the photo; the middle of the first one is (0.5, 0.5)
    double radius_px;  // of the disc of equal area
};

// Finds the light: blurs the radiance (after the thesis' inverse tone mapping) over about a hundredth of the
// picture's width, and takes the connected region around its maximum that is brighter than four fifths of it;
// the position is the region's centroid, weighted by radiance. Wide photos are reduced first. photo: 3
// perceptually coded floats a pixel.
MainLight findMainLight(const cv::Mat& photo);

} // namespace shoal::panorama
