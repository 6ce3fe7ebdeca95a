// The sRGB transfer curve, IEC 61966-2-1:1999, for one channel. Coded and linear values lie in [0, 1]; above
// 1 the power branch continues, below 0 the linear one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace shoal::math {

template <class T> T linearFromSrgb(T coded) {
    return coded <= T(0.04045) ? coded / T(12.92) : std::pow((coded + T(0.055)) / T(1.055), T(2.4));
}

template <class T> T srgbFromLinear(T linear) {
    return linear <= T(0.0031308) ? linear * T(12.92) : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

// Returns the table of linear values by 8-bit coded value.
inline const std::array<float, 256>& linearOfByte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> linear;
        for (size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
        return linear;
    }();
    return table;
}

} // namespace shoal::math
