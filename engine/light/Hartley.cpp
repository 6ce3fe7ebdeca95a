#include "engine/light/Hartley.h"

#include "engine/light/Vectorise.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

namespace shoal::light {

namespace {

constexpr int kLane = 16; // lanes that are transformed together

// Transforms the four elements a to d of kLane lanes; writes four elements.
inline void firstTwoSteps(const float* __restrict a, const float* __restrict b, const float* __restrict c,
                          const float* __restrict d, float* __restrict out) {
    for (int i = 0; i < kLane; ++i) {
        const float ab = a[i] + b[i], cd = c[i] + d[i], aLessB = a[i] - b[i], cLessD = c[i] - d[i];
        out[i] = ab + cd;
        out[kLane + i] = aLessB + cLessD;
        out[2 * kLane + i] = ab - cd;
        out[3 * kLane + i] = aLessB - cLessD;
    }
}

inline void sumAndDifference(float* __restrict a, float* __restrict b) {
    for (int i = 0; i < kLane; ++i) {
        const float sum = a[i] + b[i], difference = a[i] - b[i];
        a[i] = sum;
        b[i] = difference;
    }
}

// Combines E and O, the transforms of the even and of the odd elements, of length n. With t = pi k / n
//   H(k) = E(k) + cos t O(k) + sin t O(n - k),  H(n + k) = E(k) - cos t O(k) - sin t O(n - k),
// and the same for n - k, whose cosine is -cos t.
inline void butterfly(float* __restrict even, float* __restrict evenMirror, float* __restrict odd,
                      float* __restrict oddMirror, float cosine, float sine) {
    for (int i = 0; i < kLane; ++i) {
        const float a = cosine * odd[i] + sine * oddMirror[i];
        const float b = sine * odd[i] - cosine * oddMirror[i];
        const float e = even[i], m = evenMirror[i];
        even[i] = e + a;
        odd[i] = e - a;
        evenMirror[i] = m + b;
        oddMirror[i] = m - b;
    }
}

SHOAL_VECTORISE
void transformLanes(float* __restrict data, ptrdiff_t stride, int length, const int* order,
                    const float* cosines, const float* sines, float* __restrict work) {
    const auto from = [&](int i) { return data + order[i] * stride; };
    for (int i = 0; i < length; i += 4)
        firstTwoSteps(from(i), from(i + 1), from(i + 2), from(i + 3), work + i * kLane);
    const auto at = [&](int i) { return work + i * kLane; };
    for (int n = 4; n < length; n *= 2) {
        const int step = length / (2 * n); // distance of successive k in the tables
        for (int base = 0; base < length; base += 2 * n) {
            sumAndDifference(at(base), at(base + n));
            sumAndDifference(at(base + n / 2), at(base + n + n / 2));
            for (int k = 1; k < n / 2; ++k)
                butterfly(at(base + k), at(base + n - k), at(base + n + k), at(base + 2 * n - k),
                          cosines[k * step], sines[k * step]);
        }
    }
    for (int i = 0; i < length; ++i) std::memcpy(data + i * stride, at(i), kLane * sizeof(float));
}

} // namespace

Hartley::Hartley(int length) : length_(length) {
    assert(length >= 8 && (length & (length - 1)) == 0);
    for (int i = 0; i < length; ++i) {
        int reversed = 0;
        for (int bit = 1; bit < length; bit *= 2) reversed = reversed * 2 + ((i & bit) ? 1 : 0);
        order_.push_back(reversed);
        const double angle = 2 * std::numbers::pi * i / length;
        cosines_.push_back(static_cast<float>(std::cos(angle)));
        sines_.push_back(static_cast<float>(std::sin(angle)));
    }
    work_.resize(static_cast<size_t>(length) * kLane);
}

void Hartley::transform(float* data, int lanes) {
    assert(lanes % kLane == 0);
    for (int lane = 0; lane < lanes; lane += kLane)
        transformLanes(data + lane, lanes, length_, order_.data(), cosines_.data(), sines_.data(),
                       work_.data());
}

} // namespace shoal::light
