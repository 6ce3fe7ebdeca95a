// Blending across the wrap-around of a 360-degree strip.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

// Matches and blends the left and right end of a ring of 360 degrees (3 floats a pixel). First geometry: the
// minimum-cost alignment of the two end columns, found as a seam through all row offsets of at most 8
// degrees, warps each end half way to the other. Then colours: half of the remaining difference is subtracted
// at each end; the lower a band of the difference's spatial frequencies, the wider it fades out (multiband
// blending).
void blendWrapAround(cv::Mat& ring);

// Absolute differences of luminance between horizontal neighbours.
struct WrapDiscontinuity {
    double wrapStep = 0;  // maximum between the last column and the first
    double usualStep = 0; // 90th percentile of all others
};
WrapDiscontinuity wrapDiscontinuity(const cv::Mat& ring);

} // namespace shoal::panorama
