// Which matrix a video's luma and colour differences were made with. High-definition video is BT.709; taken
// for BT.601, its saturated colours would shift by up to 25 of 255 levels.
#pragma once

namespace shoal::media {

enum class ColourMatrix { Bt601, Bt709, Bt2020 };

const char* nameOf(ColourMatrix matrix);

// code: matrix coefficients of ISO/IEC 23091-2 (ITU-T H.273) as containers state them, 2 or 0 if they do not.
// What is not stated is told by size, as players do: BT.709 from 1280 wide or above 576 high.
ColourMatrix colourMatrixOf(int code, int width, int height);

// The weights of red and blue in luma; green has the rest.
struct Luma {
    double red, blue;
};
Luma lumaOf(ColourMatrix matrix);

} // namespace shoal::media
