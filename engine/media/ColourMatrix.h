// Which matrix a video's luma and colour differences were made with. OpenCV 4.6 decodes every video as if it
// were BT.601; high-definition video is BT.709, which would shift saturated colours by up to 25 of 255
// levels.
#pragma once

#include <array>

namespace shoal::media {

enum class ColourMatrix { Bt601, Bt709, Bt2020 };

const char* nameOf(ColourMatrix matrix);

// code: matrix coefficients of ISO/IEC 23091-2 (ITU-T H.273) as containers state them, 2 or 0 if they do not.
// What is not stated is told by size, as players do: BT.709 from 1280 wide or above 576 high.
ColourMatrix colourMatrixOf(int code, int width, int height);

// 3 x 3, row by row, acting on gamma-coded (blue, green, red) that were decoded as BT.601: gives those that
// `actual` means. Luma stays; so grey stays exactly, as every row sums to 1. Entries are multiples of 1/1024,
// the precision of the 8-bit loop that applies them.
std::array<float, 9> correctionBgr(ColourMatrix actual);

} // namespace shoal::media
