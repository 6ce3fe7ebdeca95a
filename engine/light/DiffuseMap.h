// The diffuse radiance map: thesis eq. 2.2 over pi, out(n) = 1/pi integral of L(w) max(0, n.w) dw, summed
// over every texel of a low pyramid level. A matte surface's lobe is the GGX mirror lobe of alpha 1, so a
// ZonalFilter makes it.
#pragma once

#include "engine/light/ZonalFilter.h"

namespace shoal::light {

class DiffuseMap {
  public:
    static constexpr int kWidth = 64; // the thesis' 4.1: 64x32 looks like 1024x512, 32x16 does not
    // Where a small sun stands matters: from 64 texels around, the hardest of the test surrounds comes
    // out 1.9 % off, from 128 half a percent.
    static constexpr int kSourceWidth = 128;

    void make(const RadiancePyramid& pyramid, ImageRgbF& out) {
        filterLevel(filter_, pyramid, kSourceWidth, kWidth, wide_, out);
    }

  private:
    ZonalFilter filter_{kSourceWidth, 1.0};
    ImageRgbF wide_;
};

} // namespace shoal::light
