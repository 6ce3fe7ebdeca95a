// Completion of a partial panorama, whose place in the sphere is known, to a full one.
#pragma once

#include "engine/core/Image.h"
#include "engine/panorama/Panorama.h"

namespace shoal::panorama {

// Fractions of the full lat-long picture: 0 to 1 from left to right and from top to bottom, left < right,
// top < bottom.
struct PanoramaPart {
    double left = 0, top = 0, right = 1, bottom = 1;
};

// The part is copied to its place; sky and ground are extrapolated (PolarCaps.h); a gap at the sides is
// filled by cross-fading mirror images of what lies between either end and the light. Error without a path
// where less than a pixel would be left of it.
Result<ImageRgb8> completePanorama(const ImageRgb8& photo, const PanoramaPart& part);
Result<ImageRgbF> completePanorama(const ImageRgbF& radianceLin, const PanoramaPart& part);

} // namespace shoal::panorama
