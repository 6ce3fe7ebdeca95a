// Seams: paths of one pixel a row, from the top row to the bottom row, each beside or diagonal to the last.
//
// Forward energy: Rubinstein, Shamir, Avidan, "Improved Seam Carving for Video Retargeting", SIGGRAPH 2008,
// section 5. A seam costs what its removal would make: the differences between pixels that become
// neighbours, which are those left and right of it and, where it steps sideways, one of those and the
// pixel above.
#pragma once

#include "engine/core/Image.h"

#include <algorithm>
#include <vector>

namespace shoal::panorama {

using Colours = Image<float, 3>;
using Plane = Image<float, 1>;

// The column of the cheapest seam in each row. Differences are summed over the three components; beyond the
// left and right end the picture repeats its last pixel. weight, same size, is added for each pixel that the
// seam takes; may be negative, must be finite. At equal costs the seam furthest left at the bottom row.
std::vector<int> leastSeam(const Colours& colours, const Plane& weight);

// Takes out one pixel a row.
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
