#include "engine/render/software/ShadeTexels.h"

#include "engine/core/Vectorise.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace shoal::render {

namespace {

constexpr int kOne = 64;        // sum of the weights of two texels
constexpr int kMaxTexels = 128; // across a tile

struct Between {
    int first, second, weight; // two texels; the second's weight, 0 to kOne
};

// Returns the two of coarseCount texels between whose middles the middle of texel `fine` of fineCount lies.
Between between(int fine, int fineCount, int coarseCount) {
    const int twice = (2 * fine + 1) * coarseCount -
                      fineCount; // distance from the first's middle, in 1 / (2 fineCount) texels
    const int first = twice < 0 ? -1 : twice / (2 * fineCount);
    const int weight = ((twice - first * 2 * fineCount) * kOne + fineCount) / (2 * fineCount);
    return {first, first + 1, weight};
}

using Row = std::array<uint8_t, 4 * kMaxTexels>;

// Interpolates between two rows of the map, which have been widened to the frame's columns.
SHOAL_VECTORISE void blendRows(const uint8_t* above, const uint8_t* below, int weight, size_t count,
                               uint8_t* out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = static_cast<uint8_t>((above[i] * (kOne - weight) + below[i] * weight + kOne / 2) / kOne);
}

// a b / 255, rounded.
SHOAL_VECTORISE void multiply(const uint8_t* a, const uint8_t* b, size_t count, uint8_t* out) {
    for (size_t i = 0; i < count; ++i) {
        const unsigned product = a[i] * b[i] + 128u;
        out[i] = static_cast<uint8_t>((product + (product >> 8)) >> 8);
    }
}

} // namespace

void shadeTexels(const DisplayFrame& frame, const Image<uint8_t, 4>& left, const glm::ivec2& low,
                 const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride) {
    const int width = high.x - low.x;
    assert(width <= kMaxTexels);
    std::array<Between, kMaxTexels> columns; // of the map, in bytes; they wrap around at the edges
    for (int x = 0; x < width; ++x) {
        const Between place = between(low.x + x, frame.width, left.width);
        columns[static_cast<size_t>(x)] = {4 * ((place.first + left.width) % left.width),
                                           4 * (place.second % left.width), place.weight};
    }
    // Widens a row of the map to the frame's columns.
    const auto widen = [&](int y, Row& row) {
        const uint8_t* from = left.at(0, std::clamp(y, 0, left.height - 1));
        for (size_t x = 0; x < static_cast<size_t>(width); ++x)
            for (size_t c = 0; c < 4; ++c)
                row[4 * x + c] = static_cast<uint8_t>(
                    (from[columns[x].first + static_cast<int>(c)] * (kOne - columns[x].weight) +
                     from[columns[x].second + static_cast<int>(c)] * columns[x].weight + kOne / 2) /
                    kOne);
    };
    Row above, below, factors;
    int widened = -2; // the map's row that is in `above`
    const auto bytes = 4 * static_cast<size_t>(width);
    for (int y = low.y; y < high.y; ++y) {
        const Between rows = between(y, frame.height, left.height);
        if (rows.first != widened) {
            widen(rows.first, above);
            widen(rows.second, below);
            widened = rows.first;
        }
        blendRows(above.data(), below.data(), rows.weight, bytes, factors.data());
        multiply(frame.pixels + 4 * (ptrdiff_t{y} * frame.rowPixels + low.x), factors.data(), bytes,
                 reinterpret_cast<uint8_t*>(out + y * outStride + low.x));
    }
}

} // namespace shoal::render
