// From luma and colour differences, 8 bits each, to blue, green and red. Internal to this room.
#pragma once

#include "engine/media/ColourMatrix.h"

#include <cstdint>

namespace shoal::media {

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
