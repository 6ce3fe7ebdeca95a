// From luma and colour differences, 8 bits each, to blue, green and red. Internal to this folder, but for the
// matrices.
#pragma once

#include <cstdint>

namespace shoal::media {

// Matrix coefficients of a video's luma and colour differences. High-definition video is BT.709; decoded as
// BT.601, its saturated colours would shift by up to 25 of 255 levels.
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

// A row in planes; each colour difference stands for two pixels, the last one of an odd width for one.
struct YuvRow {
    const uint8_t* luma = nullptr;
    const uint8_t* blueDifference = nullptr;
    const uint8_t* redDifference = nullptr;
};

enum class YuvLoop { Plain, Avx2 };
bool runsHere(YuvLoop loop);

class YuvToBgr {
  public:
    // fullRange: luma from 0 to 255 and differences by 255; else 16 to 235 and by 224 (BT.601 and 709, 8
    // bits).
    YuvToBgr(ColourMatrix matrix, bool fullRange);

    // Writes 3 * width bytes. Each is within 0.6 of what the formula gives, then bound to 0 .. 255; the
    // same with every loop.
    void row(const YuvRow& row, int width, uint8_t* bgr) const;
    void row(const YuvRow& row, int width, uint8_t* bgr, YuvLoop loop) const;

  private:
    void plain(const YuvRow& row, int first, int width, uint8_t* bgr) const;
    int avx2(const YuvRow& row, int width, uint8_t* bgr) const; // the first pixels; returns how many

    int16_t black_ = 0; // luma
    // Of luma by 2^13, of differences by 2^12.
    int16_t luma_ = 0, blueOfBlue_ = 0, greenOfBlue_ = 0, greenOfRed_ = 0, redOfRed_ = 0;
};

} // namespace shoal::media
