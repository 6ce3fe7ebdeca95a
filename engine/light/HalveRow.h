// Rows of interleaved texels to half as many.
#pragma once

#include <cstring>

namespace shoal::light {

// A texel, and one float of the next.
using Texel4 = float __attribute__((vector_size(16)));

inline Texel4 texelAt(const float* in) {
    Texel4 texel;
    std::memcpy(&texel, in, sizeof texel);
    return texel;
}

// out: texel x is made of what lies around 2 x and 2 x + 1 of `in`, which can be read a float further than
// that. make: gets the address of the first of the two.
template <class Make> inline void halveColumns(const float* in, int width, float* out, Make&& make) {
    // The float too much is overwritten by the next texel.
    for (int x = 0; x + 1 < width; ++x) {
        const Texel4 texel = make(in + 6 * x);
        std::memcpy(out + 3 * x, &texel, sizeof texel);
    }
    const Texel4 last = make(in + 6 * (width - 1));
    std::memcpy(out + 3 * (width - 1), &last, 3 * sizeof(float));
}

} // namespace shoal::light
