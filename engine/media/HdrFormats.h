// Decoders of high dynamic range pictures that no library reads as wanted, and the encoder of one. The errors
// have no path.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/Bytes.h"

#include <string>

namespace shoal::media {

// Radiance: RGBE pixels, flat or run-length coded. bytes: the whole file; width, height: as its header was
// found to say, orientation -Y +X. Exposure lines are not applied. Ward, "Real Pixels", Graphics Gems II,
// 1991: component = mantissa * 2^(e - 136), black where e is 0. Neither OpenCV 4.6 nor stb_image reads Ward's
// first run-length code; stb_image also takes a file that is cut short for black pixels.
Result<ImageRgbF> decodeRadiance(ByteSpan bytes, int width, int height);

// Portable float maps: "PF" or "Pf", size, scale (negative: little endian), then 32-bit floats, bottom row
// first. Paul Debevec's definition: the scale's size is a factor. OpenCV 4.6 divides by it.
Result<ImageRgbF> decodePfm(ByteSpan bytes, int width, int height);
std::string encodePfm(const ImageRgbF& image);

} // namespace shoal::media
