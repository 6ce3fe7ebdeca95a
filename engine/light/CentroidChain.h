// A chain of ever smaller copies of a lat-long map, for sums over wide lobes: a few thousand texels light a
// surface as the millions of the original map do.
#pragma once

#include "engine/core/Image.h"

#include <bit>
#include <vector>

namespace shoal::light {

// The properties of a map that a filter needs for sums over it.
struct Sampling {
    int width = 0;
    int octaves = 0;             // number of halvings from the base to this map
    std::vector<double> rowFlux; // per row: flux of one texel in light of radiance 1, steradians
};

// Each halving distributes every texel's flux over the two nearest rows and columns, in the shares that keep
// its centroid: (1 3 3 1) / 8 along rows and meridians, over the poles too. A small light keeps its position,
// and is spread by the same amount everywhere (3/16 of a texel squared for each halving, in each direction);
// ZonalFilter compensates for this spread. Plain means would move a light by up to half a texel, which
// changes the diffuse light of a small sun by 2 %.
class CentroidChain {
  public:
    explicit CentroidChain(int baseWidth); // a power of two >= 64, the width of the smallest level

    // Makes all levels. base: baseWidth x baseWidth / 2, linear radiance, each texel the mean over its solid
    // angle; it must stay alive until the next call.
    void make(const ImageRgbF& base);

    // Returns the level of this width; its radiance times Sampling::rowFlux is the flux.
    const ImageRgbF& level(int width) const;
    const Sampling& sampling(int width) const;

  private:
    int indexOf(int width) const { return std::countr_zero(unsigned(samplings_[0].width / width)); }

    const ImageRgbF* base_ = nullptr;
    std::vector<Sampling> samplings_; // widest first
    std::vector<ImageRgbF> levels_;   // of samplings_[1 ..]
    // Scratch: a row, with its last texel before it, and its first and one float behind it for halveRow().
    std::vector<float> row_;
    std::vector<float> overPole_; // the row beyond a pole
};

} // namespace shoal::light
