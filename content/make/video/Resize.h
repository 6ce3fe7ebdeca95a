// The same lat-long picture at another size.
#pragma once

#include "engine/core/Image.h"

namespace shoal::reef {

// Smaller, by means over areas.
ImageRgbF reduced(const ImageRgbF& in, int width);

} // namespace shoal::reef
