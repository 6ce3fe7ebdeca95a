// Retargeting of a photo to a ring of 360 degrees by seam insertion, as a map from the ring to the photo.
// Made on a reduced picture and smooth, so that it can be scaled to any size.
#pragma once

#include "engine/panorama/Lens.h"
#include "engine/panorama/SeamInsertion.h"

#include <vector>

namespace shoal::panorama {

// Resolution of the seam search and of the map.
inline constexpr int kMapPixelsPerDegree = 4;
inline constexpr int kMapWidth = 360 * kMapPixelsPerDegree;

// Light's place in the patch, which is the photo as a piece of the lat-long picture, at kMapPixelsPerDegree.
struct LightInPatch {
    double column = 0, row = 0, radius = 0; // pixels
};

// Column and row in the patch for each column and row of the ring, centres at whole numbers.
struct RingMap {
    std::vector<float> column; // kMapWidth
    std::vector<float> row;
    double top = 0; // latitude of the ring's upper edge, radians; the ring's rows go down from it
};

// Widens either side of the light to half the ring, or sixfold if that is less, and gives the other side the
// rest. bandLatitude: how far up and down the ring should reach, radians. The parts above and below light and
// horizon are stretched fourfold at most, so a photo with small such parts reaches less far.
RingMap makeRingMap(const cv::Mat& patch, const Lens& lens, const LightInPatch& light, double bandLatitude,
                    const Progress& progress);

} // namespace shoal::panorama
