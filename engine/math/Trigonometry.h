// Trigonometry and an exponential by additions, multiplications, divisions and square roots alone: the same
// bits on every machine. The C library's are not correctly rounded and differ by library and processor.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::math {

// Returns the sine; |angle| <= 1e6 radians. Error below 1e-9 before rounding to float: Taylor's series to
// x^15 on [-pi/2, pi/2], whose next term is (pi/2)^17 / 17! = 6e-12, after reduction by multiples of pi.
inline double sine(double angle) {
    const double turns = std::floor(angle / std::numbers::pi + 0.5);
    const double x = angle - turns * std::numbers::pi, x2 = x * x;
    double sum = 0;
    for (int n = 15; n >= 3; n -= 2) sum = (1 + sum) * (-x2 / (n * (n - 1)));
    const double value = x * (1 + sum);
    return std::floor(turns / 2) * 2 == turns ? value : -value;
}
inline float sine(float angle) { return static_cast<float>(sine(static_cast<double>(angle))); }
inline float cosine(float angle) {
    return static_cast<float>(sine(static_cast<double>(angle) + std::numbers::pi / 2));
}

// Returns the angle of (x, y) from the x axis, -pi to pi, like std::atan2; 0 for (0, 0). Error below 1e-9
// before rounding: halving the angle twice brings its tangent below tan(pi/16) = 0.2, where the first term
// that Taylor's series leaves out is 0.2^13 / 13, four times as much in the result.
inline float arcTangent(float y, float x) {
    double across = std::fabs(static_cast<double>(y)), along = std::fabs(static_cast<double>(x));
    if (across == 0 && along == 0) return 0;
    const bool steep = across > along;
    double t = steep ? along / across : across / along;
    for (int half = 0; half < 2; ++half) t /= 1 + std::sqrt(1 + t * t);
    double sum = 0;
    for (int n = 11; n >= 1; n -= 2) sum = 1.0 / n - t * t * sum;
    double angle = 4 * t * sum;
    if (steep) angle = std::numbers::pi / 2 - angle;
    if (x < 0) angle = std::numbers::pi - angle;
    return static_cast<float>(y < 0 ? -angle : angle);
}

// Returns 0 to pi; value is clamped to -1 to 1.
inline float arcCosine(float value) {
    const float x = std::clamp(value, -1.0f, 1.0f);
    return arcTangent(std::sqrt((1 - x) * (1 + x)), x);
}

// Returns the rotation by the angle about an axis of unit length.
inline glm::quat rotationAbout(glm::vec3 axis, float angle) {
    return {cosine(angle / 2), axis * sine(angle / 2)};
}

// Returns the share of the way to its goal that a value covers in dt_s: 1 - exp(-x), x = dt_s / constant_s.
// exp(x / 16) by Taylor's series to order 7, which is within 1e-9 for x <= 2, to the power of 16.
inline float followShare(float dt_s, float constant_s) {
    const double x = static_cast<double>(std::max(dt_s, 0.0f)) / static_cast<double>(constant_s) / 16;
    double power = 1;
    for (int n = 7; n >= 1; --n) power = 1 + power * x / n;
    for (int squaring = 0; squaring < 4; ++squaring) power *= power;
    return static_cast<float>(1 - 1 / power);
}

} // namespace shoal::math
