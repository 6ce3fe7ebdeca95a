// The thesis' diffuse map (eq. 2.2): every texel gathers every texel of the radiance pyramid's level of the
// same size. Half a millisecond at 64 x 32.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <vector>

namespace shoal::light {

class BruteForceDiffuse {
  public:
    static constexpr int kThesisWidth = 64;

    // width: texels around the map; the pyramids have a level of this width. A multiple of 16.
    explicit BruteForceDiffuse(int width = kThesisWidth);

    // Radiance leaving a white matte surface by its normal. Allocates nothing while out keeps its size.
    void make(const RadiancePyramid& pyramid, ImageRgbF& out);

  private:
    // Planes of the texels of the map, for the vectoriser.
    std::vector<float> x_, y_, z_;          // their directions, unit length
    std::vector<float> solidAngleOverPi_;   // steradians / pi
    std::vector<float> r_, g_, b_;          // radiance times that
    std::vector<float> sumR_, sumG_, sumB_; // what arrives
    int width_;
};

} // namespace shoal::light
