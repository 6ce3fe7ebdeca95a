// Filters a lat-long map by GGX lobes around every direction. A transform along the rows gives the sum over
// all texels for a hundredth of the multiplications.
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
    std::vector<float> cosines_, sines_; // of 2 pi k / N
    std::vector<float> work_;            // scratch for 16 lanes, which fits into the cache
};

// out(r) = sum over all texels of flux times the lobe at the texel, over the same sum for light of radiance
// 1. The lobe is math::ggxMirrorLobe; alpha = 1 is the clamped cosine of a matte surface.
//
// The sum over the columns of a row in, for a row out, is a circular convolution with an even kernel; in the
// transformed rows it is one product for each frequency. A narrow lobe has high frequencies that reach over
// few rows; a wide lobe reaches over all rows, with low frequencies only. Values below 2e-6 of the
// whole are left out, and the rest is scaled so that uniform light stays exactly as it is.
//
// The kernel compensates, to second order, for the texels' spread of light (Sampling::octaves) and for linear
// lookups between them: it is nearly the map of this size with the least squared error.
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
        size_t kernel = 0; // index of its values: for each input row, one for each output row of the block
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
