// The two ends of a ring, made to meet.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

// Matches and blends the left and right end of a ring of 360 degrees (3 floats a pixel). First heights: the
// cheapest alignment of the two end columns, found as a seam through all row offsets of at most 8 degrees,
// bends each end half way to the other. Then colours: half of what still differs is taken off each end; the
// coarser a band of the difference's spatial frequencies, the wider it fades out, as a membrane
// stretched over it would.
void closeRing(cv::Mat& ring);

// Steps of luminance from each pixel to its right neighbour, absolute.
struct JointStrength {
    double joint = 0;     // the largest from the last column to the first
    double jointMean = 0; // their mean
    double usual = 0;     // the 90th percentile of all others
};
JointStrength jointStrength(const cv::Mat& ring);

} // namespace shoal::panorama
