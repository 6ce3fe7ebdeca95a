#include "engine/light/ZonalFilter.h"

#include "engine/light/Vectorise.h"
#include "engine/math/Brdf.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cassert>

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

// Of values at texel centres: the new centre lies midway between four old ones, so the plain mean is meant,
// not the one by solid angles (which lies nearer to the equator).
void halveSamples(const ImageRgbF& in, ImageRgbF& out) {
    if (out.width != in.width / 2 || out.height != in.height / 2)
        out = ImageRgbF(in.width / 2, in.height / 2);
    for (int y = 0; y < out.height; ++y) {
        const float *top = in.at(0, 2 * y), *bottom = in.at(0, 2 * y + 1);
        float* to = out.at(0, y);
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 3; ++c)
                to[3 * x + c] =
                    0.25f * (top[6 * x + c] + top[6 * x + 3 + c] + bottom[6 * x + c] + bottom[6 * x + 3 + c]);
    }
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

// The lobe around the centre of row `out`, integrated over the texels of every row and column difference: two
// by two points of Gauss, exact for cubics. Result: [column difference][row in].
void lobeOfRow(int out, int width, double alpha, const std::vector<double>& cosines,
               std::vector<float>& lobe) {
    const int height = width / 2;
    const double latitudeOut = pi * (0.5 - (out + 0.5) / height);
    const double up = std::sin(latitudeOut), along = std::cos(latitudeOut);
    for (int in = 0; in < height; ++in) {
        const double solidAngle = texelSolidAngle(in, width, height);
        double sines[2], rings[2];
        for (int s = 0; s < 2; ++s) {
            const double latitude = pi * (0.5 - (in + 0.5 + (s - 0.5) / std::numbers::sqrt3) / height);
            sines[s] = up * std::sin(latitude);
            rings[s] = along * std::cos(latitude);
        }
        for (int d = 0; d <= width / 2; ++d) {
            double sum = 0;
            for (int s = 0; s < 2; ++s)
                for (int t = 0; t < 2; ++t)
                    sum += math::ggxMirrorLobe(sines[s] + rings[s] * cosines[static_cast<size_t>(2 * d + t)],
                                               alpha);
            const auto value = static_cast<float>(sum * solidAngle / 4);
            lobe[static_cast<size_t>(d) * height + in] = value;
            lobe[static_cast<size_t>((width - d) % width) * height + in] = value;
        }
    }
}

} // namespace

ZonalFilter::ZonalFilter(int width, double alpha) : width_(width), height_(width / 2), hartley_(width) {
    assert(width >= 2 * kBlock && alpha > 0);
    static_assert(kBlock == kRows);
    makeKernel(alpha);
    columns_.resize(static_cast<size_t>(width_) * 3 * height_);
    filtered_.resize(columns_.size());
}

void ZonalFilter::makeKernel(double alpha) {
    std::vector<double> cosines; // of the two points of each column difference
    for (int d = 0; d <= width_ / 2; ++d)
        for (int t = 0; t < 2; ++t)
            cosines.push_back(std::cos(2 * pi * (d + (t - 0.5) / std::numbers::sqrt3) / width_));

    const int frequencies = width_ / 2 + 1, blocks = height_ / kBlock;
    const size_t plane = static_cast<size_t>(width_) * height_;
    std::vector<float> lobes(plane * kBlock); // of each row out of a block, transformed: [frequency][row in]
    std::vector<float> lobe(plane);
    std::vector<std::vector<float>> kernels(static_cast<size_t>(blocks));
    ranges_.resize(static_cast<size_t>(frequencies) * blocks);
    // South of the equator the kernel is the north's, with rows in and out counted from the other end.
    for (int block = 0; block < (blocks + 1) / 2; ++block) {
        for (int i = 0; i < kBlock; ++i) {
            lobeOfRow(block * kBlock + i, width_, alpha, cosines, lobe);
            double whole = 0;
            for (const float value : lobe) whole += static_cast<double>(value);
            hartley_.transform(lobe.data(), height_);
            // Frequency 0 is the sum over the columns: what a uniform surround gives. Its rows kept must sum
            // to 1.
            double kept = 0;
            for (int in = 0; in < height_; ++in) {
                const double share = static_cast<double>(lobe[static_cast<size_t>(in)]);
                if (share > kNegligible * whole) kept += share;
            }
            for (size_t j = 0; j < plane; ++j)
                lobes[plane * static_cast<size_t>(i) + j] =
                    static_cast<float>(static_cast<double>(lobe[j]) / kept);
        }
        for (int m = 0; m < frequencies; ++m) {
            const auto share = [&](int in, int i) {
                float& value = lobes[plane * static_cast<size_t>(i) + static_cast<size_t>(m) * height_ + in];
                if (std::abs(static_cast<double>(value)) <= kNegligible) value = 0;
                return value;
            };
            int first = height_, last = -1;
            for (int in = 0; in < height_; ++in)
                for (int i = 0; i < kBlock; ++i)
                    if (share(in, i) != 0) first = std::min(first, in), last = in;
            if (last < 0) first = 0;
            const Range range{first, std::max(0, last + 1 - first), kernel_.size()};
            ranges_[static_cast<size_t>(m) * blocks + block] = range;
            for (int in = first; in <= last; ++in)
                for (int i = 0; i < kBlock; ++i) kernel_.push_back(share(in, i));
            const int mirror = blocks - 1 - block;
            if (mirror == block) continue;
            ranges_[static_cast<size_t>(m) * blocks + mirror] = {height_ - first - range.count, range.count,
                                                                 kernel_.size()};
            for (size_t end = kernel_.size(), back = end; back > range.kernel; --back)
                kernel_.push_back(kernel_[back - 1]);
        }
    }
    kernel_.shrink_to_fit();
}

void ZonalFilter::apply(const ImageRgbF& in, ImageRgbF& out) {
    assert(in.width == width_ && in.height == height_);
    if (out.width != width_ || out.height != height_) out = ImageRgbF(width_, height_);
    toColumns(in.pixels.data(), width_, height_, columns_.data());
    hartley_.transform(columns_.data(), 3 * height_);
    const int blocks = height_ / kBlock;
    for (int block = 0; block < blocks; ++block)
        for (int m = 0; m <= width_ / 2; ++m) {
            const Range& range = ranges_[static_cast<size_t>(m) * blocks + block];
            std::array<const float*, kSignals> from;
            std::array<float*, kSignals> to;
            for (int s = 0; s < kSignals; ++s) {
                const int k = s < 3 ? m : (width_ - m) % width_;
                const size_t at = (static_cast<size_t>(k) * 3 + s % 3) * height_;
                from[static_cast<size_t>(s)] = columns_.data() + at + range.first;
                to[static_cast<size_t>(s)] = filtered_.data() + at + block * kBlock;
            }
            combine(kernel_.data() + range.kernel, range.count, from, to);
        }
    hartley_.transform(filtered_.data(), 3 * height_);
    fromColumns(filtered_.data(), width_, height_, 1.0f / static_cast<float>(width_), out.pixels.data());
}

void filterLevel(ZonalFilter& filter, const RadiancePyramid& pyramid, int sourceWidth, int width,
                 ImageRgbF& wide, ImageRgbF& out) {
    assert(sourceWidth == width || sourceWidth == 2 * width);
    const auto source = std::find_if(pyramid.levels.begin(), pyramid.levels.end(),
                                     [&](const ImageRgbF& level) { return level.width == sourceWidth; });
    assert(source != pyramid.levels.end());
    filter.apply(*source, sourceWidth == width ? out : wide);
    if (sourceWidth != width) halveSamples(wide, out);
}

} // namespace shoal::light
