// The main light of a photo.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

struct MainLight {
    cv::Point2d place; // pixels of the photo; the middle of the first one is (0.5, 0.5)
    double radius_px;  // of the disc of equal area
};

// The middle of the brightest spot: radiance after the thesis' inverse tone mapping, averaged over about a
// hundredth of the picture's width, has its maximum there; the spot is all that hangs together with it and is
// brighter than four fifths of that, weighed by its radiance. photo: 3 coded floats, at most some 1000 pixels
// wide (wider ones only cost time).
MainLight findLight(const cv::Mat& photo);

} // namespace shoal::panorama
