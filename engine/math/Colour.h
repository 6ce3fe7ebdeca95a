// The sRGB transfer curve, IEC 61966-2-1:1999, one channel at a time. Coded and linear values in [0, 1];
// beyond it the curve's power branch goes on, below zero its straight branch.
#pragma once

#include <cmath>

namespace shoal::math {

template <class T> T linearFromSrgb(T coded) {
    return coded <= T(0.04045) ? coded / T(12.92) : std::pow((coded + T(0.055)) / T(1.055), T(2.4));
}

template <class T> T srgbFromLinear(T linear) {
    return linear <= T(0.0031308) ? linear * T(12.92) : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

} // namespace shoal::math
