// Filters a lat-long map by GGX lobes. For each direction it sums over all texels; Hartley transforms of the
// rows reduce the multiplications to a hundredth.
#pragma once

#include "engine/light/CentroidChain.h"
#include "engine/light/EnvironmentLight.h"

#include <span>
#include <vector>

namespace shoal::light {

// The fast Hartley transform of many sequences side by side.
//
// H(k) = sum over n of x(n) (cos + sin)(2 pi k n / N). It is real and its own inverse but for a factor N. A
// circular convolution with an even kernel is a product, as in a Fourier transform: H_out(k) = K(k) H_in(k),
// with K(k) = K(N - k). Bracewell 1984, "The fast Hartley transform".
class Hartley {
  public:
    explicit Hartley(int length); // N, a power of two >= 8

    // Transforms in place `lanes` sequences: element n of lane i at data[n * lanes + i]. lanes: a multiple of
    // 16. One thread at a time.
    void transform(float* data, int lanes);

  private:
    int length_;
    std::vector<int> order_;             // bit-reversed index of each element
    std::vector<float> cosines_, sines_; // cos and sin of 2 pi k / N
    std::vector<float> work_;            // scratch for 16 lanes, which fits into the cache
};

// out(r) = sum over all texels of flux times the lobe at the texel, over the same sum for light of radiance
// 1. The lobe is math::ggxMirrorLobe; alpha = 1 is the clamped cosine of a matte surface.
//
// For each pair of an input and an output row, the sum over columns is a circular convolution with an even
// kernel: one product for each frequency of the transformed rows. The kernel of a narrow lobe is non-zero in
// few input rows, that of a wide lobe at low frequencies only. Values below 2e-6 of an output row's sum are
// set to zero, and the rest is scaled so that uniform light does not change.
//
// The kernel compensates, to second order, for the blur by averaging over texels (Sampling::octaves) and by
// linear lookups between them, so that the map is nearly the one of this size with the least squared error.
class ZonalFilter {
  public:
    // sampling.width: a power of two >= 32, the width of the maps in and out. Kernels take 1 ms (64) to 1 s
    // (512) and 0.1 to some 10 MB for each alpha.
    ZonalFilter(const Sampling& sampling, const std::vector<double>& alphas);

    // Writes to level i of `out` the map filtered by the lobe of alphas[i]. All maps: width x width / 2;
    // those of `out` are resized. Linear radiance; results are not negative. One thread at a time.
    void apply(const ImageRgbF& in, std::span<GlossyLevel> out);

    int width() const { return width_; }
    size_t lobes() const { return kernels_.size(); }

  private:
    struct Range {
        int first = 0, count = 0; // input rows
        size_t kernel = 0;        // index in Kernel::values of [input row][output row of the block]
    };
    // The kernel of the northern half; the southern half counts input and output rows from the south.
    struct Kernel {
        std::vector<Range> ranges; // [frequency][northern block of rows out]
        std::vector<float> values;
    };

    Kernel kernelOf(double alpha, const Sampling& sampling);
    void appendBlock(int block, const std::vector<float>& lobes, const std::vector<double>& gains,
                     Kernel& kernel) const;
    void filter(const Kernel& kernel);

    int width_, height_;
    int blocks_; // blocks of output rows in the northern half, which share ranges of input rows
    Hartley hartley_;
    std::vector<Kernel> kernels_;
    std::vector<float> columns_, filtered_; // [column or frequency][channel][row]
};

} // namespace shoal::light
