// A view of a decoded frame, or of one eye's rectangle of it: owns nothing, copies nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal::light {

// Lat-long, 8 bits a channel, display-coded, three bytes a pixel.
struct FrameView {
    const uint8_t* pixels = nullptr; // the top left pixel of the rectangle
    int width = 0, height = 0;       // pixels
    ptrdiff_t rowStride = 0;         // bytes from one row to the next
    bool bgr = true;                 // byte order blue, green, red; else red, green, blue

    const uint8_t* row(ptrdiff_t y) const { return pixels + y * rowStride; }
};

} // namespace shoal::light
