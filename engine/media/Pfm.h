// Portable float maps: "PF" or "Pf", size, scale (negative: little endian), then 32-bit floats, bottom row
// first. Paul Debevec's definition; the scale's size is applied as a factor.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <span>
#include <string>

namespace shoal::media {

// width, height: as the header was found to say. The error has no path.
Result<ImageRgbF> decodePfm(std::span<const uint8_t> bytes, int width, int height);

std::string encodePfm(const ImageRgbF& image);

} // namespace shoal::media
