// The density of a clipped pixel is the share of its surroundings that is clipped too: nearly 1 inside a sun,
// a lamp or a window, a few hundredths at glints on waves or gaps between leaves, hardly brighter than white.
//
// The upper half of a lat-long frame is divided into cells of 1.4 degrees; a cell's density is the mean over
// 3 x 3 cells, wider along rows near the pole. A light that moves across cells keeps its density.
#pragma once

#include <cstddef>
#include <vector>

namespace shoal::light {

class ClippedDensity {
  public:
    // Begins a frame. Allocates nothing while the size stays.
    void begin(int width, int height);
    // Adds a row at the horizon or above it. clipped: `width` values, 0 to 1.
    void addRow(int y, const float* clipped);
    void finish(); // after the last row

    // Multiplies a row's values by their densities.
    void weigh(int y, float* clipped) const;

  private:
    size_t cellRow(int y) const { return static_cast<size_t>(y) * rows_ / static_cast<size_t>(height_); }

    int width_ = 0, height_ = 0;        // of the frame
    size_t columns_ = 0, rows_ = 0;     // of cells, on the whole sphere
    std::vector<int> starts_;           // first pixel of each cell in a row, and the last one's end
    std::vector<int> counts_;           // by row of cells: rows of the frame in it
    std::vector<char> anything_;        // by row of cells: whether anything is clipped in it
    std::vector<float> sums_, density_; // columns_ x rows_
    std::vector<float> across_;         // scratch: columns_ x rows_
};

} // namespace shoal::light
