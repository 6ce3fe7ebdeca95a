// A frame as it is drawn.
#pragma once

#include <cstdint>

namespace shoal::render {

// Display-coded rows of a frame or of one eye's part of it, from the top: blue, green, red and a byte that is
// 255. Drivers keep such texels as they come; three bytes a pixel they would turn into these first.
struct DisplayFrame {
    const uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    int rowPixels = 0; // from one row to the next, in pixels
};

} // namespace shoal::render
