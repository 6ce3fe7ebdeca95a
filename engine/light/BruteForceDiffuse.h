// The thesis' diffuse map (eq. 2.2): every texel gathers every texel of the radiance pyramid's level of the
// same size. Half a millisecond at 64 x 32.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <array>
#include <vector>

namespace shoal::light {

class BruteForceDiffuse {
  public:
    static constexpr int kThesisWidth = 64;

    // width: texels around the map, a power of two of at least 16; a narrower pyramid's width from then on.
    explicit BruteForceDiffuse(int width = kThesisWidth);

    // Makes the map of a white matte surface's radiance. Allocates nothing while out keeps its size.
    void make(const RadiancePyramid& pyramid, ImageRgbF& out);

    // Three arrays over the map's texels: x, y, z of their directions, or red, green, blue of their light.
    using Planes = std::array<std::vector<float>, 3>;

  private:
    Planes directions_;                   // unit length
    std::vector<float> solidAngleOverPi_; // steradians / pi
    Planes light_;                        // radiance times that
    int width_;
};

} // namespace shoal::light
