// Filters a lat-long map by a GGX lobe around every direction, by a transform along the rows: the whole sum
// over all texels for a hundredth of its multiplications.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/Hartley.h"

#include <cstdint>
#include <vector>

namespace shoal::light {

// out(r) = sum over all texels of radiance times the lobe integrated over the texel, over the sum of the
// latter; the lobe is math::ggxMirrorLobe, alpha = 1 the clamped cosine of a matte surface.
//
// Turning the surround by one column turns the result, so for a row out and a row in the sum over columns is
// a circular convolution with an even kernel; in the transformed rows it is one product for each frequency. A
// narrow lobe has high frequencies, but those reach over few rows; a wide lobe reaches over all rows, but has
// low frequencies only. What is below kNegligible of the whole is left out, and the rest scaled so that
// uniform light stays exactly as it is.
class ZonalFilter {
  public:
    // width: of the map, a power of two >= 32. Takes 1 ms (64) to 0.3 s (512) and 0.1 to some 10 MB.
    ZonalFilter(int width, double alpha);

    // in, out: width x width / 2; out is made so. Linear radiance; nothing negative comes out. One thread at
    // a time.
    void apply(const ImageRgbF& in, ImageRgbF& out);

    size_t kernelFloats() const { return kernel_.size(); }

  private:
    static constexpr int kBlock = 16; // rows out that share a range of rows in
    static constexpr double kNegligible = 2e-6;

    struct Range {
        int first = 0, count = 0; // rows in
        size_t kernel = 0;        // index of kBlock floats for each of them
    };

    void makeKernel(double alpha);

    int width_, height_;
    Hartley hartley_;
    std::vector<Range> ranges_; // [frequency][block of rows out]
    std::vector<float> kernel_;
    std::vector<float> columns_, filtered_; // [column or frequency][channel][row]
};

// Filters the pyramid's level of sourceWidth, halving the result where width is half that;
// `wide` is scratch.
void filterLevel(ZonalFilter& filter, const RadiancePyramid& pyramid, int sourceWidth, int width,
                 ImageRgbF& wide, ImageRgbF& out);

} // namespace shoal::light
