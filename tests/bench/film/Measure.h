// Differences between a decoded picture of a film and the picture that was encoded.
#pragma once

#include "engine/core/Image.h"

#include <array>
#include <cstddef>

namespace shoal::bench {

// Spatial frequencies in bands of a sixth of an octave, from kLowest up, in cycles around.
constexpr int kBands = 24;
constexpr double kLowest = 128;
double bandFrequency(int band); // returns its middle

// Sums over pictures. Both are lat-long; the decoded one is enlarged to the true one's size first.
class Distance {
  public:
    void add(const ImageRgb8& truthRgb, const ImageRgb8& decodedBgr);

    // Root mean square error in linear light over the sphere, as a share of the truth's root mean square.
    double errorLinear() const;
    double psnrLuma_dB() const;
    // Share of the truth's detail in a band that is found in the right place: the cross spectrum's real part
    // over the truth's power.
    double gain(int band) const;
    // Highest frequency, in cycles around, up to which gain() is at least a half.
    double detail() const;

  private:
    double squared_ = 0, truthSquared_ = 0, lumaSquared_ = 0, weights_ = 0;
    std::array<double, kBands> cross_{}, power_{};
};

// Steps of luma from column to column where blocks of 8, 16, 32 or 64 meet, over those elsewhere, in the
// upper part of the picture (open water), for the worst of these sizes; 1: no blocks to be seen.
double blockiness(const ImageRgb8& bgr);

} // namespace shoal::bench
