// Converts luma and colour differences, 8 bits each, to blue, green and red. Internal to this folder, except
// for the matrices.
#pragma once

#include "engine/core/Image.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace shoal::media {

// Matrix coefficients of a video's luma and colour differences. High-definition video is BT.709; decoded as
// BT.601, its saturated colours would shift by up to 25 of 255 levels. The values are codes of ISO/IEC
// 23091-2 (ITU-T H.273), which FFmpeg has too.
enum class ColourMatrix { Bt709 = 1, Bt601 = 5, Bt2020 = 9 };

const char* nameOf(ColourMatrix matrix);

// Returns the matrix that a container's code states. Without a known code (2 and 0 mean unstated) it follows
// from the size, as in other players: BT.709 from 1280 wide or above 576 high.
ColourMatrix colourMatrixOf(int code, int width, int height);

// Weights of red and blue in luma; green's is 1 minus both.
struct Luma {
    double red, blue;
};
Luma lumaOf(ColourMatrix matrix);

// A picture in planes: luma, blue and red difference. Each difference stands for two pixels of a row, the
// last one of an odd width for one.
struct YuvPicture {
    std::array<const uint8_t*, 3> planes;
    std::array<ptrdiff_t, 3> strides; // bytes
    int rowsPerDifference;            // 1 or 2
    ColourMatrix matrix;
    bool fullRange; // luma 0 to 255, differences span 255; else 16 to 235 and 224 (BT.601 and 709)
};

// Writes a picture of the size that bgr has. Values are within 0.6 of the formula's, clamped to 0 .. 255.
void toBgr(const YuvPicture& yuv, ImageRgb8& bgr);

} // namespace shoal::media
