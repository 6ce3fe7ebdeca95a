// How much of what is around a clipped pixel is clipped as well: nearly all inside a sun, a lamp or a window,
// a few hundredths where waves glint or gaps between leaves shine, which are hardly brighter than white.
//
// The upper half of a lat-long frame in cells of 1.4 degrees; the density of a cell is the mean over 3 x 3 of
// them, wider along rows near the pole. One that moves from cell to cell keeps its own.
#pragma once

#include <cstddef>
#include <vector>

namespace shoal::light {

class ClippedDensity {
  public:
    // Nothing is allocated while the size stays.
    void begin(int width, int height);
    // A row at the horizon or above it. clipped: `width` values, 0 to 1.
    void addRow(int y, const float* clipped);
    void finish(); // after the last row

    // Multiplies a row's values by their densities.
    void weigh(int y, float* clipped) const;

  private:
    size_t cellRow(int y) const { return static_cast<size_t>(y) * rows_ / static_cast<size_t>(height_); }

    int width_ = 0, height_ = 0;        // of the frame
    size_t columns_ = 0, rows_ = 0;     // of cells, on the whole sphere
    std::vector<int> starts_;           // of a cell's pixels in a row, and the end of the last
    std::vector<int> counts_;           // of the frame's rows in a row of cells
    std::vector<char> anything_;        // is clipped in a row of cells
    std::vector<float> sums_, density_; // columns_ x rows_
    std::vector<float> across_;         // scratch, as many
};

} // namespace shoal::light
