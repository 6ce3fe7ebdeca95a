#include "engine/light/Hartley.h"

#include "engine/light/SixteenFloats.h"
#include "engine/light/Vectorise.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace shoal::light {

namespace {

constexpr int kLane = 16; // lanes taken through all steps together

// Where element n of the sequences begins.
struct Elements {
    float* data;
    ptrdiff_t stride; // floats
    float* operator()(int n) const { return data + n * stride; }
};

// Transforms of four elements each, which lie in `in` in the order given.
inline void firstTwoSteps(const Elements& in, const int* order, int length, const Elements& out) {
    for (int base = 0; base < length; base += 4) {
        Sixteen a, b, c, d;
        load(in(order[base]), a);
        load(in(order[base + 1]), b);
        load(in(order[base + 2]), c);
        load(in(order[base + 3]), d);
        const Sixteen ab = a + b, cd = c + d, aLessB = a - b, cLessD = c - d;
        store(ab + cd, out(base));
        store(aLessB + cLessD, out(base + 1));
        store(ab - cd, out(base + 2));
        store(aLessB - cLessD, out(base + 3));
    }
}

inline void sumAndDifference(int a, int b, const Elements& in, const Elements& out) {
    Sixteen first, second;
    load(in(a), first);
    load(in(b), second);
    store(first + second, out(a));
    store(first - second, out(b));
}

// E, O: transforms of the even and the odd elements, half as long (n). With angle t = pi k / n
//   H(k) = E(k) + cos t O(k) + sin t O(n - k),  H(n + k) = E(k) - cos t O(k) - sin t O(n - k),
// and the same for n - k, whose cosine is -cos t. From E, O at base .. base + 2 n - 1; step: of k in the
// tables.
inline void doubled(int base, int n, int step, const float* cosines, const float* sines, const Elements& in,
                    const Elements& out) {
    sumAndDifference(base, base + n, in, out);
    sumAndDifference(base + n / 2, base + n + n / 2, in, out);
    for (int k = 1; k < n / 2; ++k) {
        const float cosine = cosines[k * step], sine = sines[k * step];
        Sixteen even, evenMirror, odd, oddMirror;
        load(in(base + k), even);
        load(in(base + n - k), evenMirror);
        load(in(base + n + k), odd);
        load(in(base + 2 * n - k), oddMirror);
        const Sixteen a = cosine * odd + sine * oddMirror, b = sine * odd - cosine * oddMirror;
        store(even + a, out(base + k));
        store(evenMirror + b, out(base + n - k));
        store(even - a, out(base + n + k));
        store(evenMirror - b, out(base + 2 * n - k));
    }
}

SHOAL_VECTORISE
void transformLanes(float* data, ptrdiff_t stride, int length, const int* order, const float* cosines,
                    const float* sines, float* work) {
    const Elements all{data, stride}, close{work, kLane};
    firstTwoSteps(all, order, length, close);
    int n = 4;
    for (; 2 * n < length; n *= 2)
        for (int base = 0; base < length; base += 2 * n)
            doubled(base, n, length / (2 * n), cosines, sines, close, close);
    doubled(0, n, 1, cosines, sines, close, all);
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
