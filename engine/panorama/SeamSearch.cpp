#include "engine/panorama/SeamSearch.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace shoal::panorama {

namespace {

float difference(const float* a, const float* b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

} // namespace

std::vector<int> minSeam(const Colours& colours, const Plane& weight) {
    const int w = colours.width, h = colours.height;
    assert(w > 0 && h > 0 && weight.width == w && weight.height == h);
    constexpr float kNever = std::numeric_limits<float>::max();
    const auto cell = [](int x) { return static_cast<size_t>(x); };

    // Minimum cost of a seam down to each pixel of a row, with a sentinel at each end, and its predecessor.
    std::vector<float> above(cell(w) + 2, kNever), here(cell(w) + 2, kNever);
    std::vector<float> apart(cell(w)), turnLeft(cell(w)), turnRight(cell(w));
    Image<int8_t, 1> from(w, h);
    for (int y = 0; y < h; ++y) {
        const float* row = colours.at(0, y);
        const float* over = colours.at(0, std::max(y - 1, 0));
        for (int x = 0; x < w; ++x) {
            const float* left = row + 3 * std::max(x - 1, 0);
            const float* right = row + 3 * std::min(x + 1, w - 1);
            apart[cell(x)] = difference(left, right) + *weight.at(x, y);
            turnLeft[cell(x)] = difference(over + 3 * x, left);
            turnRight[cell(x)] = difference(over + 3 * x, right);
        }
        if (y == 0) {
            std::copy(apart.begin(), apart.end(), here.begin() + 1);
        } else {
            int8_t* cameFrom = from.at(0, y);
            for (int x = 0; x < w; ++x) {
                const float l = above[cell(x)] + turnLeft[cell(x)], u = above[cell(x) + 1],
                            r = above[cell(x) + 2] + turnRight[cell(x)];
                const float minimum = std::min(std::min(l, u), r);
                cameFrom[x] = static_cast<int8_t>(u == minimum ? 0 : l == minimum ? -1 : 1);
                here[cell(x) + 1] = minimum + apart[cell(x)];
            }
        }
        std::swap(above, here);
    }

    std::vector<int> seam(cell(h));
    int x = static_cast<int>(std::min_element(above.begin() + 1, above.end() - 1) - above.begin()) - 1;
    for (int y = h - 1; y >= 0; --y) {
        seam[cell(y)] = x;
        x += *from.at(x, y);
    }
    return seam;
}

} // namespace shoal::panorama
