// From a photo's own field of view to a ring of 360 degrees, as a map: where each place of the ring comes
// from. Made on a reduced picture and smooth, so that it can be carried up to any size.
#pragma once

#include "engine/panorama/Grow.h"
#include "engine/panorama/Lens.h"

#include <vector>

namespace shoal::panorama {

// Seams are sought, and maps kept, at this many pixels a degree.
inline constexpr int kMapPixelsPerDegree = 4;
inline constexpr int kMapWidth = 360 * kMapPixelsPerDegree;

// The light in the patch: the photo as a piece of the lat-long picture, kMapPixelsPerDegree.
struct LightInPatch {
    double column = 0, row = 0, radius = 0; // pixels
};

// For each column and row of the ring, which of the patch, centres at whole numbers.
struct RingMap {
    std::vector<float> column; // kMapWidth
    std::vector<float> row;
    double top = 0; // latitude of the ring's upper edge, radians; the ring's rows go down from it
};

// Either side of the light grows to half the ring, or sixfold if that is less, and the other takes the
// rest. bandLatitude: how far up and down the ring should reach, radians. Where little of the photo lies
// above or below its light and horizon it reaches less far: no such part grows more than fourfold.
RingMap widen(const Colours& patch, const Lens& lens, const LightInPatch& light, double bandLatitude,
              const Progress& progress);

} // namespace shoal::panorama
