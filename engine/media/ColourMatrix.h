// Matrix coefficients of a video's luma and colour differences. High-definition video is BT.709; decoded as
// BT.601, its saturated colours would shift by up to 25 of 255 levels.
#pragma once

namespace shoal::media {

enum class ColourMatrix { Bt601, Bt709, Bt2020 };

const char* nameOf(ColourMatrix matrix);

// code: matrix coefficients of ISO/IEC 23091-2 (ITU-T H.273) as containers state them, 2 or 0 if they do not.
// Unstated ones follow from the size, as in other players: BT.709 from 1280 wide or above 576 high.
ColourMatrix colourMatrixOf(int code, int width, int height);

// Weights of red and blue in luma; green's is 1 minus both.
struct Luma {
    double red, blue;
};
Luma lumaOf(ColourMatrix matrix);

} // namespace shoal::media
