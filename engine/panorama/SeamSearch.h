// Search for minimum-cost seams: connected paths from the top row to the bottom row, one pixel a row.
//
// Forward energy: Rubinstein, Shamir, Avidan, "Improved Seam Carving for Video Retargeting", SIGGRAPH 2008,
// section 5. The cost of a seam is the sum of the differences between pixels that its removal would make
// neighbours: those left and right of it and, where it steps sideways, one of those and the pixel above.
#pragma once

#include "engine/core/Image.h"

#include <algorithm>
#include <vector>

namespace shoal::panorama {

using Colours = Image<float, 3>;
using Plane = Image<float, 1>;

// The column of the minimum-cost seam in each row. Differences are summed over the three components; beyond
// the left and right edge the picture repeats its last pixel. weight, of the same size, is added for each
// pixel of the seam; it may be negative, and must be finite. Of equal costs the leftmost at the bottom row.
std::vector<int> minSeam(const Colours& colours, const Plane& weight);

// Removes one pixel a row.
template <class T, int kChannels> void removeSeam(Image<T, kChannels>& image, const std::vector<int>& seam) {
    auto to = image.pixels.begin();
    auto from = image.pixels.begin();
    for (int y = 0; y < image.height; ++y) {
        const auto taken = from + static_cast<ptrdiff_t>(seam[static_cast<size_t>(y)]) * kChannels;
        const auto next = from + static_cast<ptrdiff_t>(image.width) * kChannels;
        to = std::copy(from, taken, to);
        to = std::copy(taken + kChannels, next, to);
        from = next;
    }
    image.width -= 1;
    image.pixels.erase(to, image.pixels.end());
}

} // namespace shoal::panorama
