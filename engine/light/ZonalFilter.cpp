#include "engine/light/ZonalFilter.h"

#include "engine/light/Vectorise.h"
#include "engine/math/Brdf.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

using std::numbers::pi;

constexpr int kRows = 16;   // ZonalFilter::kBlock
constexpr int kSignals = 6; // three channels at frequency k and at N - k, which have the same kernel

// For each signal: out[0 .. 15] = sum over rows in of kernel row times signal.
SHOAL_VECTORISE
void combine(const float* __restrict kernel, int count, const std::array<const float*, kSignals>& in,
             const std::array<float*, kSignals>& out) {
    float sums[kSignals][kRows] = {};
    for (int row = 0; row < count; ++row) {
        const float* weights = kernel + row * kRows;
        for (int s = 0; s < kSignals; ++s) {
            const float value = in[static_cast<size_t>(s)][row];
            for (int i = 0; i < kRows; ++i) sums[s][i] += weights[i] * value;
        }
    }
    for (int s = 0; s < kSignals; ++s)
        for (int i = 0; i < kRows; ++i) out[static_cast<size_t>(s)][i] = sums[s][i];
}

// Rows of interleaved texels to columns of planes and back, kRows rows at a time for the cache's sake.
SHOAL_VECTORISE
void toColumns(const float* __restrict image, int width, int height, float* __restrict columns) {
    for (int y = 0; y < height; y += kRows)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < kRows; ++i)
                    columns[(x * 3 + c) * height + y + i] = image[((y + i) * width + x) * 3 + c];
}

SHOAL_VECTORISE
void fromColumns(const float* __restrict columns, int width, int height, float scale,
                 float* __restrict image) {
    for (int y = 0; y < height; y += kRows)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < kRows; ++i) {
                    // Rounding may leave a hair below zero where no light comes from.
                    const float value = columns[(x * 3 + c) * height + y + i] * scale;
                    image[((y + i) * width + x) * 3 + c] = value > 0 ? value : 0.0f;
                }
}

double sinc(double x) { return x == 0 ? 1.0 : std::sin(x) / x; }

// out[d] += the lobe at two points of column difference d, summed.
SHOAL_VECTORISE
void addLobe(const double* __restrict cosines, int count, double sine, double ring, double alpha,
             double* __restrict out) {
    for (int d = 0; d < count; ++d)
        out[d] += math::ggxMirrorLobe(sine + ring * cosines[2 * d], alpha) +
                  math::ggxMirrorLobe(sine + ring * cosines[2 * d + 1], alpha);
}

// The lobes around the rows from `out` on, kRows + 2 of them, over as many rows from `in` on: the mean over a
// texel of the row in, for column differences 0 .. width / 2; two by two points of Gauss, exact for cubics.
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

// Variance, in texels squared, of what the map and the mean over a texel spread light by, less that of the
// plain means it came from: what inside those was, nobody knows.
double spreadVariance(int octaves) {
    const double rest = std::pow(0.25, octaves);
    return 0.25 * (1 - rest) + (1 - rest) / 12;
}

// The same spread along a row, exactly, as what it leaves of frequency m; and how linear lookup is best
// prepared for: least squares among linear splines on these texels.
double columnGain(int m, int width, int octaves) {
    const double x = pi * m / width;
    double response = sinc(x) / sinc(x * std::pow(0.5, octaves));
    for (int i = 1; i <= octaves; ++i) response *= std::pow(std::cos(x * std::pow(0.5, i)), 3);
    constexpr double kLeast = 0.4; // above, more is folded than told
    const double spline = sinc(x) * sinc(x) * 3 / (2 + std::cos(2 * x));
    return spline / std::max(response, kLeast);
}

} // namespace

ZonalFilter::ZonalFilter(const Sampling& sampling, const std::vector<double>& alphas)
    : width_(sampling.width), height_(width_ / 2), hartley_(width_) {
    assert(width_ >= 2 * kBlock);
    static_assert(kBlock == kRows);
    for (const double alpha : alphas) kernels_.push_back(kernelOf(alpha, sampling));
    columns_.resize(static_cast<size_t>(width_) * 3 * height_);
    filtered_.resize(columns_.size());
}

ZonalFilter::Kernel ZonalFilter::kernelOf(double alpha, const Sampling& sampling) const {
    assert(alpha > 0);
    std::vector<double> cosines; // of the two points of each column difference
    for (int d = 0; d <= width_ / 2; ++d)
        for (int t = 0; t < 2; ++t)
            cosines.push_back(std::cos(2 * pi * (d + (t - 0.5) / std::numbers::sqrt3) / width_));
    const int frequencies = width_ / 2 + 1, blocks = height_ / kBlock;
    std::vector<double> gains;
    for (int m = 0; m < frequencies; ++m) gains.push_back(columnGain(m, width_, sampling.octaves));
    const double spread = -0.5 * spreadVariance(sampling.octaves);
    constexpr double kSide = -1.0 / 12; // the spline's preparation again, from row to row

    const auto n = static_cast<size_t>(frequencies);
    std::vector<double> raw(n * (kRows + 2) * (kRows + 2)), sharp(n * (kRows + 2));
    std::vector<float> tile(static_cast<size_t>(width_) * kRows); // [column difference or frequency][row in]
    std::vector<float> lobes(n * static_cast<size_t>(height_) * kRows); // [frequency][row in][row out]
    Kernel kernel;
    kernel.ranges.resize(n * static_cast<size_t>(blocks));
    // South of the equator the kernel is the north's, with rows in and out counted from the other end.
    for (int block = 0; block < (blocks + 1) / 2; ++block) {
        for (int first = 0; first < height_; first += kRows) {
            lobesOfTile(block * kBlock - 1, first - 1, width_, alpha, cosines, raw);
            for (int out = 0; out < kRows; ++out) {
                const double* above = raw.data() + static_cast<size_t>(out) * sharp.size();
                const double *here = above + sharp.size(), *below = here + sharp.size();
                for (size_t j = 0; j < sharp.size(); ++j)
                    sharp[j] = here[j] + kSide * (above[j] - 2 * here[j] + below[j]);
                for (int in = 0; in < kRows; ++in) {
                    const double* row = sharp.data() + (in + 1) * frequencies;
                    const double flux = sampling.rowFlux[static_cast<size_t>(first + in)];
                    for (int d = 0; d < frequencies; ++d) {
                        const double bent = row[d - frequencies] - 2 * row[d] + row[d + frequencies];
                        const auto value = static_cast<float>((row[d] + spread * bent) * flux);
                        tile[static_cast<size_t>(d * kRows + in)] = value;
                        tile[static_cast<size_t>((width_ - d) % width_ * kRows + in)] = value;
                    }
                }
                hartley_.transform(tile.data(), kRows);
                for (int m = 0; m < frequencies; ++m)
                    for (int in = 0; in < kRows; ++in)
                        lobes[static_cast<size_t>((m * height_ + first + in) * kRows + out)] =
                            tile[static_cast<size_t>(m * kRows + in)];
            }
        }

        // Frequency 0 is the sum over the columns: what a uniform surround gives. Its rows kept must sum
        // to 1.
        std::array<double, kRows> whole{}, kept{};
        for (int in = 0; in < height_; ++in)
            for (size_t out = 0; out < kRows; ++out)
                whole[out] += static_cast<double>(lobes[static_cast<size_t>(in) * kRows + out]);
        for (int in = 0; in < height_; ++in)
            for (size_t out = 0; out < kRows; ++out) {
                const double share = static_cast<double>(lobes[static_cast<size_t>(in) * kRows + out]);
                if (std::abs(share) > kNegligible * whole[out]) kept[out] += share;
            }

        for (int m = 0; m < frequencies; ++m) {
            const auto share = [&, gain = gains[static_cast<size_t>(m)]](int in, size_t out) {
                const double value =
                    static_cast<double>(lobes[static_cast<size_t>(m * height_ + in) * kRows + out]);
                return std::abs(value) > kNegligible * whole[out]
                           ? static_cast<float>(gain * value / kept[out])
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
            kernel.ranges[static_cast<size_t>(m * blocks + block)] = range;
            for (int in = first; in <= last; ++in)
                for (size_t out = 0; out < kRows; ++out) kernel.values.push_back(share(in, out));
            const int mirror = blocks - 1 - block;
            if (mirror == block) continue;
            kernel.ranges[static_cast<size_t>(m * blocks + mirror)] = {height_ - first - range.count,
                                                                       range.count, kernel.values.size()};
            for (size_t end = kernel.values.size(), back = end; back > range.kernel; --back)
                kernel.values.push_back(kernel.values[back - 1]);
        }
    }
    kernel.values.shrink_to_fit();
    return kernel;
}

void ZonalFilter::filter(const Kernel& kernel) {
    const int blocks = height_ / kBlock;
    for (int block = 0; block < blocks; ++block)
        for (int m = 0; m <= width_ / 2; ++m) {
            const Range& range = kernel.ranges[static_cast<size_t>(m) * blocks + block];
            std::array<const float*, kSignals> from;
            std::array<float*, kSignals> to;
            for (int s = 0; s < kSignals; ++s) {
                const int k = s < 3 ? m : (width_ - m) % width_;
                const size_t at = (static_cast<size_t>(k) * 3 + s % 3) * height_;
                from[static_cast<size_t>(s)] = columns_.data() + at + range.first;
                to[static_cast<size_t>(s)] = filtered_.data() + at + block * kBlock;
            }
            combine(kernel.values.data() + range.kernel, range.count, from, to);
        }
}

void ZonalFilter::apply(const ImageRgbF& in, std::span<ImageRgbF* const> out) {
    assert(in.width == width_ && in.height == height_ && out.size() == kernels_.size());
    toColumns(in.pixels.data(), width_, height_, columns_.data());
    hartley_.transform(columns_.data(), 3 * height_);
    for (size_t i = 0; i < out.size(); ++i) {
        if (out[i]->width != width_ || out[i]->height != height_) *out[i] = ImageRgbF(width_, height_);
        filter(kernels_[i]);
        hartley_.transform(filtered_.data(), 3 * height_);
        fromColumns(filtered_.data(), width_, height_, 1.0f / static_cast<float>(width_),
                    out[i]->pixels.data());
    }
}

} // namespace shoal::light
