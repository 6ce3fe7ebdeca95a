// Resizing of lat-long pictures.
#pragma once

#include "engine/core/Image.h"

namespace shoal::reef {

// Returns a smaller picture, by means over areas.
ImageRgbF reduced(const ImageRgbF& in, int width);

} // namespace shoal::reef
