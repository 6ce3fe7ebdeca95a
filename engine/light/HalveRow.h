// Rows of interleaved texels to half their number.
#pragma once

#include <cstring>

namespace shoal::light {

// Texels 0, 2, 4 .. 2 count - 2 of `in`, which has a float before its end to spare, side by side.
inline void everySecondTexel(const float* in, int count, float* out) {
    // Four floats at a time, the last of which the next three overwrite.
    for (int x = 0; x + 1 < count; ++x) std::memcpy(out + 3 * x, in + 6 * x, 4 * sizeof(float));
    std::memcpy(out + 3 * (count - 1), in + 6 * (count - 1), 3 * sizeof(float));
}

} // namespace shoal::light
