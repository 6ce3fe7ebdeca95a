// How far a decoded picture of a film is from the picture that was encoded.
#pragma once

#include "engine/core/Image.h"

#include <array>
#include <cstddef>

namespace shoal::bench {

// Spatial frequencies in bands of a sixth of an octave, from kLowest up, in cycles around.
constexpr int kBands = 24;
constexpr double kLowest = 128;
double bandFrequency(int band); // its middle

// Sums over pictures. Both are lat-long; the decoded one is enlarged to the true one's size first.
class Distance {
  public:
    void add(const ImageRgb8& truthRgb, const ImageRgb8& decodedBgr);

    // Root mean square in linear light over the sphere, of the truth's own root mean square.
    double errorLinear() const;
    double psnrLuma_dB() const;
    // Share of what the truth holds in a band that is found in its place: real part of the cross spectrum
    // over the truth's power.
    double gain(int band) const;
    // Cycles around up to which at least half is found.
    double detail() const;

  private:
    double squared_ = 0, truthSquared_ = 0, lumaSquared_ = 0, weights_ = 0;
    std::array<double, kBands> cross_{}, power_{};
};

// Steps of luma from column to column where blocks of 8, 16, 32 or 64 meet, over those elsewhere, in the
// upper part of the picture (open water), for the worst of these sizes; 1: no blocks to be seen.
double blockiness(const ImageRgb8& bgr);

} // namespace shoal::bench
