// Smoothing of values that follow others over time.
#pragma once

#include <algorithm>

namespace shoal::math {

// Returns the share of the way to its goal that a value covers in dt_s: 1 - exp(-x), x = dt_s / constant_s.
// Basic arithmetic gives the same bits on every machine (see Trigonometry.h): exp(x / 16) by Taylor's series
// to order 7, which is within 1e-9 for x <= 2, to the power of 16.
inline float followShare(float dt_s, float constant_s) {
    const double x = static_cast<double>(std::max(dt_s, 0.0f)) / static_cast<double>(constant_s) / 16;
    double power = 1;
    for (int n = 7; n >= 1; --n) power = 1 + power * x / n;
    for (int squaring = 0; squaring < 4; ++squaring) power *= power;
    return static_cast<float>(1 - 1 / power);
}

} // namespace shoal::math
