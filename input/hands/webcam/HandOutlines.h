// Palm, fingers and gesture of each hand outline in a segmentation mask.
#pragma once

#include "input/hands/HandFilter.h"

#include <opencv2/core.hpp>

#include <vector>

namespace shoal::hands {

struct Outline {
    cv::Point2f palm;  // pixels; the middle of the largest circle inside the outline
    float radius = 0;  // of that circle, pixels
    int clefts = 0;    // deep narrow gaps between fingers that stand
    bool ring = false; // thumb and index enclose a hole
    int thumb = 0; // of an open hand, fingers up: 1 on the right of the picture, -1 on the left; 0 unknown
    float highest = 0; // of the outline above the palm's middle, in radii
    Gesture gesture = Gesture::Open;
};

// mask: 8-bit, 255 where a hand may be. The largest outlines first, two at most.
std::vector<Outline> findHands(const cv::Mat& mask);

} // namespace shoal::hands
