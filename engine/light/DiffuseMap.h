// The diffuse radiance map: thesis eq. 2.2 over pi, by brute force over the pyramid's 64x32 level.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

constexpr int kDiffuseWidth = 64; // the thesis' 4.1: 64x32 looks like 1024x512, 32x16 does not

// out(n) = 1/pi integral of L(w) max(0, n.w) dw, each texel's share of the cosine integrated over the texel.
//
// Turning surround and normal together by one column changes nothing, so the sum over a row's columns is a
// circular convolution with an even kernel: a product, frequency by frequency, after a Fourier transform
// along the rows. That is the same sum with a tenth of the multiplications. The kernel takes 0.1 s to make
// and 0.5 MB.
class DiffuseMap {
  public:
    DiffuseMap();

    // in: 64x32. out: made 64x32. A uniform surround comes out as it went in, to rounding. One thread at a
    // time.
    void make(const ImageRgbF& in, ImageRgbF& out);

  private:
    static constexpr int kWidth = kDiffuseWidth, kHeight = kWidth / 2, kFrequencies = kWidth / 2 + 1;
    static constexpr int kRun = 3 * kHeight; // one column of the map: channel by channel, row by row

    std::vector<float> basis_;       // [wave][column], orthonormal
    std::vector<float> basisTurned_; // [column][wave]
    std::vector<float> kernel_;      // [frequency][row in][row out]
    std::vector<float> columns_, waves_, lit_;
};

} // namespace shoal::light
