// A photo that says which part of the full surround it is.
#pragma once

#include "engine/core/Image.h"
#include "engine/panorama/Panorama.h"

namespace shoal::panorama {

// Shares of the full lat-long picture: 0 to 1 from left to right and from top to bottom, left < right,
// top < bottom.
struct Part {
    double left = 0, top = 0, right = 1, bottom = 1;
};

// The part in its place, unbent; sky and ground continued as grow() does; a gap at the sides is filled by
// what lies between either end and the light, mirrored, one fading into the other. Error without a path
// where less than a pixel would be left of it.
Result<ImageRgb8> place(const ImageRgb8& photo, const Part& part);
Result<ImageRgbF> place(const ImageRgbF& radianceLin, const Part& part);

} // namespace shoal::panorama
