#include "engine/light/Hartley.h"

#include "engine/light/Vectorise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

constexpr int kLane = 16; // lanes taken through all stages together, so that they stay in the cache

inline void exchange(float* __restrict a, float* __restrict b) {
    for (int i = 0; i < kLane; ++i) {
        const float keep = a[i];
        a[i] = b[i];
        b[i] = keep;
    }
}

inline void sumAndDifference(float* __restrict a, float* __restrict b) {
    for (int i = 0; i < kLane; ++i) {
        const float sum = a[i] + b[i], difference = a[i] - b[i];
        a[i] = sum;
        b[i] = difference;
    }
}

// E, O: transforms of the even and the odd elements, half as long (n). With angle t = pi k / n
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
void transformLanes(float* data, int stride, int length, const int* swaps, int swapCount,
                    const float* cosines, const float* sines) {
    const auto at = [&](int n) { return data + static_cast<long>(n) * stride; };
    for (int i = 0; i < swapCount; i += 2) exchange(at(swaps[i]), at(swaps[i + 1]));
    for (int n = 1; n < length; n *= 2) {
        const int step = length / (2 * n); // of k in the tables
        for (int base = 0; base < length; base += 2 * n) {
            sumAndDifference(at(base), at(base + n));
            if (n >= 2) sumAndDifference(at(base + n / 2), at(base + n + n / 2));
            for (int k = 1; k < n / 2; ++k)
                butterfly(at(base + k), at(base + n - k), at(base + n + k), at(base + 2 * n - k),
                          cosines[k * step], sines[k * step]);
        }
    }
}

} // namespace

Hartley::Hartley(int length) : length_(length) {
    assert(length >= 2 && (length & (length - 1)) == 0);
    for (int i = 0; i < length; ++i) {
        int reversed = 0;
        for (int bit = 1; bit < length; bit *= 2) reversed = reversed * 2 + ((i & bit) ? 1 : 0);
        if (i < reversed) swaps_.insert(swaps_.end(), {i, reversed});
        const double angle = 2 * std::numbers::pi * i / length;
        cosines_.push_back(static_cast<float>(std::cos(angle)));
        sines_.push_back(static_cast<float>(std::sin(angle)));
    }
}

void Hartley::transform(float* data, int lanes) const {
    assert(lanes % kLane == 0);
    for (int lane = 0; lane < lanes; lane += kLane)
        transformLanes(data + lane, lanes, length_, swaps_.data(), static_cast<int>(swaps_.size()),
                       cosines_.data(), sines_.data());
}

} // namespace shoal::light
