// Samples of a radiance pyramid around a direction that stand for a lobe: what sampling for each pixel and
// filtering maps beforehand have in common.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/glm.hpp>

#include <vector>

namespace shoal::light::baselines {

constexpr int kFittedTaps = 36; // at most; rings of no use are left out

struct Tap {
    glm::vec3 local{0, 0, 1}; // unit length; z along the lobe's axis
    float lod = 0;            // level of the pyramid
    float weight = 0;         // of all taps they sum to 1
};

// Samples of math::ggxMirrorLobe: half vectors as GGX distributes them (Walter et al. 2007, eq. 35 and 36),
// weighed by the cosine as Karis 2013 does, each read from the level whose texels are as large as the
// sample's share of the sphere, 1 / (samples * density) (Krivanek and Colbert 2008). baseWidth: of level 0.
std::vector<Tap> ggxTaps(float roughness, int samples, int baseWidth);

// Trilinear.
glm::vec3 gather(const RadiancePyramid& pyramid, const std::vector<Tap>& taps, const glm::vec3& axis);

// Few taps for a lobe, fitted by least squares.
//
// Manson and Sloan 2016 fit the places, levels and weights of few trilinear taps to the lobe. Theirs are
// polynomials over the faces of a cube map; on the lat-long map one set of rings around the axis serves, and
// the fit can be done on Legendre coefficients: a ring of taps at the angle t read from a level with texels
// of size s answers to band l with P_l(cos t) exp(-l (l + 1) s^2 / 8) (a texel's box and the linear
// interpolation between texels have together the variance s^2 / 4 on each axis). The level follows from the
// distance between a ring's taps, weights follow by least squares, angles by descent.
//
// Levels are whole: each tap is one bilinear lookup. Weights are above 0.
std::vector<Tap> fittedTaps(float roughness, int baseWidth);

// Gathers for every texel of a width x width / 2 map. Turning about the vertical moves all taps of a row
// alike, so where they lie is worked out once for each row, not for each texel.
class TapFilter {
  public:
    TapFilter(const std::vector<Tap>& taps, int width, int baseWidth);

    // One thread at a time.
    void apply(const RadiancePyramid& pyramid, ImageRgbF& out);

  private:
    struct Place {
        int level = 0;
        int top = 0, bottom = 0; // rows
        float topWeight = 0, bottomWeight = 0;
        float column = 0; // for column 0 of the map, in texels of the level, >= 0
    };
    int width_;
    size_t placesPerRow_ = 0;
    std::vector<float> blended_; // two rows of a level
    std::vector<Place> places_;  // [row][places; those that weigh nothing fill up]
};

} // namespace shoal::light::baselines
