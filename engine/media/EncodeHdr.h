// High dynamic range pictures as the bytes of their files. Internal to this folder.
#pragma once

#include "engine/core/Image.h"

#include <string>

namespace shoal::media {

// Radiance RGBE, run-length coded.
std::string encodeRadiance(const ImageRgbF& image);

std::string encodePfm(const ImageRgbF& image);

} // namespace shoal::media
