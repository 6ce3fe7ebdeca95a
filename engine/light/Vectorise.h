// Loops over texels, for sums and for halving rows, in a form that compilers vectorise.
#pragma once

#include "engine/core/Vectorise.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace shoal::light {

// Returns each channel's sum over interleaved values. 16 partial sums let compilers vectorise the loop.
template <size_t kChannels> inline std::array<float, kChannels> sumsOf(const float* values, size_t count) {
    std::array<float, 16 * kChannels> parts{};
    size_t at = 0;
    for (; at + parts.size() <= count; at += parts.size())
        for (size_t i = 0; i < parts.size(); ++i) parts[i] += values[at + i];
    for (size_t i = 0; at + i < count; ++i) parts[i] += values[at + i];
    for (size_t half = 8 * kChannels; half >= kChannels; half /= 2)
        for (size_t i = 0; i < half; ++i) parts[i] += parts[half + i];
    std::array<float, kChannels> sums;
    std::copy_n(parts.begin(), kChannels, sums.begin());
    return sums;
}

// --- Halving rows of interleaved texels -----------------------------------------------------------------

// A texel of three floats, and the first float of the next texel.
using Texel4 = float __attribute__((vector_size(16)));

inline Texel4 texelAt(const float* in) {
    Texel4 texel;
    std::memcpy(&texel, in, sizeof texel);
    return texel;
}

// Writes to texel x of `out` what make(address of texel 2 x of `in`) returns. One float past the end of `in`
// must be readable.
template <class Make> inline void halveColumns(const float* in, int width, float* out, Make&& make) {
    // The extra float is overwritten by the next texel.
    for (int x = 0; x + 1 < width; ++x) {
        const Texel4 texel = make(in + 6 * x);
        std::memcpy(out + 3 * x, &texel, sizeof texel);
    }
    const Texel4 last = make(in + 6 * (width - 1));
    std::memcpy(out + 3 * (width - 1), &last, 3 * sizeof(float));
}

} // namespace shoal::light
