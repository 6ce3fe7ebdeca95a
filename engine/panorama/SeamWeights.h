// Weights that keep seams away from the light and from vertical edges.
#pragma once

#include "engine/panorama/SeamSearch.h"

namespace shoal::panorama {

// No seam may cross the columns from middle - half to middle + half; beyond them the weight falls over `fade`
// columns.
struct ProtectedColumns {
    double middle = 0, half = 0, fade = 0; // pixels
};

// Weights for seamInsertionMap(): prohibitive within the protected columns, high along vertical edges as long
// as a quarter of the picture's height, and slightly raised by any texture.
Plane seamWeights(const Colours& picture, const ProtectedColumns& columns);

} // namespace shoal::panorama
