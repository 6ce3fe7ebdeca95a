// Radiance pictures: RGBE pixels, flat or run-length coded. Read here rather than by OpenCV, which reads
// them from a file again and speaks to standard error of those cut short.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <span>

namespace shoal::media {

// bytes: the whole file; width, height: as its header was found to say, orientation -Y +X. Exposure lines in
// the header are not applied. Ward, "Real Pixels", Graphics Gems II, 1991: component = mantissa * 2^(e -
// 136), black where e is 0. The error has no path.
Result<ImageRgbF> decodeRadiance(std::span<const uint8_t> bytes, int width, int height);

} // namespace shoal::media
