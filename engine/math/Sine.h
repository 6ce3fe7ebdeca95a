// Sine from additions and multiplications alone, so that it has the same bits on every machine; the C
// library's is not correctly rounded and differs between libraries.
#pragma once

#include <cmath>
#include <numbers>

namespace shoal::math {

// |angle| <= 1e6 radians. Error below 1e-9 before the result is rounded to float: Taylor's series to x^15 on
// [-pi/2, pi/2], whose next term is (pi/2)^17 / 17! = 6e-12, after reduction by multiples of pi.
inline float sine(float angle) {
    const double turns = std::floor(static_cast<double>(angle) / std::numbers::pi + 0.5);
    const double x = static_cast<double>(angle) - turns * std::numbers::pi, x2 = x * x;
    double sum = 0;
    for (int n = 15; n >= 3; n -= 2) sum = (1 + sum) * (-x2 / (n * (n - 1)));
    const double value = x * (1 + sum);
    return static_cast<float>(std::floor(turns / 2) * 2 == turns ? value : -value);
}

} // namespace shoal::math
