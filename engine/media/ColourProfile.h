// Conversion of a photo's colours by its ICC profile.
#pragma once

#include "engine/core/Image.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shoal::media {

// Converts a picture in place to sRGB: relative colorimetric, with the black point of sRGB. profile:
// untrusted; of red, green and blue, or of grey where all pixels are grey. Empty: none. Returns what was
// done, a clause after "; "; empty: there is no profile, or it gives the colours of sRGB. A damaged one, or
// one of other components than the picture's, is ignored.
std::string convertToSrgb(std::span<const uint8_t> profile, ImageRgb8& picture);

// Returns an ICC profile of this gamma (0: sRGB's curve) and these CIE x and y of white, red, green and blue;
// empty if they span no colours.
std::vector<uint8_t> rgbProfile(double gamma, const std::array<double, 8>& xy);

} // namespace shoal::media
