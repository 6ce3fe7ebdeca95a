#include "engine/light/ZonalFilter.h"

#include "engine/core/Vectorise.h"
#include "engine/math/Brdf.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>

namespace shoal::light {

namespace {

using std::numbers::pi;

constexpr int kRows = 16;      // output rows of a block
constexpr size_t kSignals = 6; // three channels at frequencies k and width - k, which share a kernel

// Computes out[0 .. 15] for each signal in turn: the sum over `count` input rows of kernel row times signal.
// step: stride of input rows: 1, or -1 for the southern half, whose output rows also count from the south.
// Each register width has its own version; in a common version, compilers would keep the sums in memory.
#ifdef SHOAL_VERSIONS
#define SHOAL_TARGET __attribute__((target("arch=x86-64-v4")))
#define SHOAL_FLOATS 16
#include "engine/light/CombineRows.inl"
#define SHOAL_TARGET __attribute__((target("avx2")))
#define SHOAL_FLOATS 8
#include "engine/light/CombineRows.inl"
#define SHOAL_TARGET __attribute__((target("default")))
#else
#define SHOAL_TARGET
#endif
#define SHOAL_FLOATS 4
#include "engine/light/CombineRows.inl"

// Writes out[x][y] = max(0, scale * in[y][x]) by bands, which stay in the cache. height: a multiple of kRows.
SHOAL_VECTORISE
void transpose(const float* in, int width, int height, float scale, float* out) {
    for (int top = 0; top < height; top += kRows)
        for (int x = 0; x < width; ++x)
            for (int y = top; y < top + kRows; ++y)
                out[x * height + y] = std::max(0.0f, scale * in[y * width + x]);
}

double sinc(double x) { return x == 0 ? 1.0 : std::sin(x) / x; }

// Adds to out[d] the sum of the lobe's values at the two Gauss points of column difference d.
SHOAL_VECTORISE
void addLobe(const double* __restrict cosines, int count, double sine, double ring, double alpha,
             double* __restrict out) {
    for (int d = 0; d < count; ++d)
        out[d] += math::ggxMirrorLobe(sine + ring * cosines[2 * d], alpha) +
                  math::ggxMirrorLobe(sine + ring * cosines[2 * d + 1], alpha);
}

// Computes the lobes of kRows + 2 output rows from `out` on at as many input rows from `in` on, for column
// differences 0 to width / 2. Each is a sum over 2 x 2 Gauss points of the input texel, exact for cubics.
// Rows beyond a pole lie on the other side of it. Result: [row out][row in][column difference].
void lobesOfTile(int out, int in, int width, double alpha, const std::vector<double>& cosines,
                 std::vector<double>& lobes) {
    const int height = width / 2, differences = width / 2 + 1;
    std::fill(lobes.begin(), lobes.end(), 0.0);
    double* to = lobes.data();
    for (int o = out; o < out + kRows + 2; ++o) {
        const double latitudeOut = pi * (0.5 - (o + 0.5) / height);
        const double up = std::sin(latitudeOut), along = std::cos(latitudeOut);
        for (int i = in; i < in + kRows + 2; ++i, to += differences)
            for (int s = 0; s < 2; ++s) {
                const double latitude = pi * (0.5 - (i + 0.5 + (s - 0.5) / std::numbers::sqrt3) / height);
                addLobe(cosines.data(), differences, up * std::sin(latitude), along * std::cos(latitude),
                        alpha, to);
            }
    }
}

// Returns the variance, in texels^2, of the blur by the halvings and by the mean over a texel. The blur
// within the original texels is left out, because the distribution of light in them is unknown.
double spreadVariance(int octaves) {
    const double rest = std::pow(0.25, octaves);
    return 0.25 * (1 - rest) + (1 - rest) / 12;
}

// Returns the gain for frequency m along a row. It undoes the exact attenuation by the same spread, and it
// prefilters for linear lookups: the result is the least-squares fit of a linear spline on these texels.
double columnGain(int m, int width, int octaves) {
    const double x = pi * m / width;
    double response = sinc(x) / sinc(x * std::pow(0.5, octaves));
    for (int i = 1; i <= octaves; ++i) response *= std::pow(std::cos(x * std::pow(0.5, i)), 3);
    constexpr double kMin = 0.4; // below this response, aliasing outweighs light
    const double spline = sinc(x) * sinc(x) * 3 / (2 + std::cos(2 * x));
    return spline / std::max(response, kMin);
}

constexpr int kLane = 16; // number of sequences that are transformed together

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

ZonalFilter::ZonalFilter(const Sampling& sampling, const std::vector<double>& alphas)
    : width_(sampling.width), height_(width_ / 2), blocks_((height_ / kRows + 1) / 2), hartley_(width_) {
    assert(width_ >= 2 * kRows);
    for (const double alpha : alphas) kernels_.push_back(kernelOf(alpha, sampling));
    columns_.resize(static_cast<size_t>(width_) * 3 * height_);
    filtered_.resize(columns_.size());
}

ZonalFilter::Kernel ZonalFilter::kernelOf(double alpha, const Sampling& sampling) {
    assert(alpha > 0);
    std::vector<double> cosines; // at the two Gauss points of each column difference
    for (int d = 0; d <= width_ / 2; ++d)
        for (int t = 0; t < 2; ++t)
            cosines.push_back(std::cos(2 * pi * (d + (t - 0.5) / std::numbers::sqrt3) / width_));
    const int frequencies = width_ / 2 + 1;
    std::vector<double> gains;
    for (int m = 0; m < frequencies; ++m) gains.push_back(columnGain(m, width_, sampling.octaves));
    const double spread = -0.5 * spreadVariance(sampling.octaves);
    constexpr double kSide = -1.0 / 12; // prefilters for linear lookups between rows, too

    const auto n = static_cast<size_t>(frequencies);
    std::vector<double> raw(n * (kRows + 2) * (kRows + 2)), sharp(n * (kRows + 2));
    std::vector<float> tile(static_cast<size_t>(width_) * kRows); // [column difference or frequency][row in]
    std::vector<float> lobes(n * static_cast<size_t>(height_) * kRows); // [frequency][row in][row out]
    Kernel kernel;
    kernel.ranges.resize(n * static_cast<size_t>(blocks_));
    for (int block = 0; block < blocks_; ++block) {
        for (int first = 0; first < height_; first += kRows) {
            lobesOfTile(block * kRows - 1, first - 1, width_, alpha, cosines, raw);
            for (int out = 0; out < kRows; ++out) {
                const double* above = raw.data() + static_cast<size_t>(out) * sharp.size();
                const double *here = above + sharp.size(), *below = here + sharp.size();
                for (size_t j = 0; j < sharp.size(); ++j)
                    sharp[j] = here[j] + kSide * (above[j] - 2 * here[j] + below[j]);
                for (int in = 0; in < kRows; ++in) {
                    const double* row = sharp.data() + (in + 1) * frequencies;
                    const double flux = sampling.rowFlux[first + in];
                    for (int d = 0; d < frequencies; ++d) {
                        const double bent = row[d - frequencies] - 2 * row[d] + row[d + frequencies];
                        const auto value = static_cast<float>((row[d] + spread * bent) * flux);
                        tile[d * kRows + in] = value;
                        tile[(width_ - d) % width_ * kRows + in] = value;
                    }
                }
                hartley_.transform(tile.data(), kRows);
                for (int m = 0; m < frequencies; ++m)
                    for (int in = 0; in < kRows; ++in)
                        lobes[(m * height_ + first + in) * kRows + out] = tile[m * kRows + in];
            }
        }
        appendBlock(block, lobes, gains, kernel);
    }
    kernel.values.shrink_to_fit();
    return kernel;
}

// Appends the kernel of a block, only for contributing input rows. lobes: [frequency][row in][row out].
void ZonalFilter::appendBlock(int block, const std::vector<float>& lobes, const std::vector<double>& gains,
                              Kernel& kernel) const {
    constexpr double kNegligible = 2e-6;
    const auto lobe = [&](int m, int in, size_t out) {
        return static_cast<double>(lobes[static_cast<size_t>(m * height_ + in) * kRows + out]);
    };
    // Frequency 0 is the sum over columns: the result in uniform light. Kept values are scaled to sum to 1.
    std::array<double, kRows> whole{}, kept{};
    for (int in = 0; in < height_; ++in)
        for (size_t out = 0; out < kRows; ++out) whole[out] += lobe(0, in, out);
    for (int in = 0; in < height_; ++in)
        for (size_t out = 0; out < kRows; ++out) {
            const double share = lobe(0, in, out);
            if (std::abs(share) > kNegligible * whole[out]) kept[out] += share;
        }

    for (int m = 0; m <= width_ / 2; ++m) {
        const auto share = [&, gain = gains[m]](int in, size_t out) {
            const double value = lobe(m, in, out);
            return std::abs(value) > kNegligible * whole[out] ? static_cast<float>(gain * value / kept[out])
                                                              : 0.0f;
        };
        const auto reaches = [&](int in) {
            for (size_t out = 0; out < kRows; ++out)
                if (share(in, out) != 0) return true;
            return false;
        };
        int first = 0, last = height_ - 1;
        while (first < height_ && !reaches(first)) ++first;
        while (last > first && !reaches(last)) --last;
        if (first == height_) first = 0, last = -1;
        const Range range{first, last + 1 - first, kernel.values.size()};
        kernel.ranges[m * blocks_ + block] = range;
        for (int in = first; in <= last; ++in)
            for (size_t out = 0; out < kRows; ++out) kernel.values.push_back(share(in, out));
    }
}

void ZonalFilter::filter(const Kernel& kernel) {
    for (int block = 0; block < blocks_; ++block)
        for (int m = 0; m <= width_ / 2; ++m) {
            const Range& range = kernel.ranges[m * blocks_ + block];
            const float* weights = kernel.values.data() + range.kernel;
            const int north = block * kRows, south = height_ - kRows - north;
            std::array<const float*, kSignals> northIn, southIn;
            std::array<float*, kSignals> northOut, southOut;
            for (size_t s = 0; s < kSignals; ++s) {
                const int k = s < 3 ? m : (width_ - m) % width_;
                const size_t at = (static_cast<size_t>(k) * 3 + s % 3) * static_cast<size_t>(height_);
                northIn[s] = columns_.data() + at + range.first;
                southIn[s] = columns_.data() + at + height_ - 1 - range.first;
                northOut[s] = filtered_.data() + at + north;
                southOut[s] = filtered_.data() + at + south;
            }
            float sums[kSignals * kRows];
            combine(weights, range.count, 1, northIn, sums);
            for (size_t s = 0; s < kSignals; ++s) std::copy_n(sums + s * kRows, kRows, northOut[s]);
            if (south == north) continue;
            combine(weights, range.count, -1, southIn, sums);
            for (size_t s = 0; s < kSignals; ++s)
                std::reverse_copy(sums + s * kRows, sums + (s + 1) * kRows, southOut[s]);
        }
}

void ZonalFilter::apply(const ImageRgbF& in, std::span<GlossyLevel> out) {
    assert(in.width == width_ && in.height == height_ && out.size() == kernels_.size());
    transpose(in.pixels.data(), 3 * width_, height_, 1, columns_.data());
    hartley_.transform(columns_.data(), 3 * height_);
    for (size_t i = 0; i < out.size(); ++i) {
        out[i].radianceLin.fit(width_, height_);
        filter(kernels_[i]);
        hartley_.transform(filtered_.data(), 3 * height_);
        // Rounding errors may leave values slightly below zero where no light arrives.
        transpose(filtered_.data(), height_, 3 * width_, 1.0f / static_cast<float>(width_),
                  out[i].radianceLin.pixels.data());
    }
}

} // namespace shoal::light
