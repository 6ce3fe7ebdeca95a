// PNG and JPEG in memory, the two formats of core glTF.
#pragma once

#include "engine/core/Image.h"

#include <cstdint>
#include <span>
#include <string>

namespace shoal::scene {

struct Loading;

// Size is read from the header and held against the limits before anything is decoded. who: the glTF element,
// for messages. Grey and palette images are spread to RGBA; 16-bit ones keep their upper 8 bits. Throws
// Fault.
ImageRgba8 decodeImage(Loading& loading, std::span<const uint8_t> bytes, const std::string& who);

} // namespace shoal::scene
