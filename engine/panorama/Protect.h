// What growing should leave alone.
#pragma once

#include "engine/panorama/Seams.h"

namespace shoal::panorama {

// A part of a row: columns from middle - half to middle + half are not to be touched at all; beyond them
// growth sets in softly over `fade` more.
struct Strip {
    double middle = 0, half = 0, fade = 0; // pixels
};

// Weights for seams from top to bottom: as good as closed across the strip in every row, dear along upright
// edges as long as a quarter of the picture's height, and a little dearer wherever there is structure.
Plane protect(const Colours& picture, const Strip& strip);

} // namespace shoal::panorama
