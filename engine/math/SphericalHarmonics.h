// Real, orthonormal spherical harmonics to band 4 on the env frame's x, y, z, and the irradiance of matte
// surfaces from them.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/LatLong.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace shoal::math {

constexpr int kShBands = 5; // l = 0 .. 4
constexpr int kShCount = kShBands * kShBands;

// Calls visit(radiance, solid angle in steradians, direction) for each texel of a lat-long map.
template <class Visit> void eachTexel(const ImageRgbF& map, Visit&& visit) {
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = texelSolidAngle(y, map.width, map.height);
        for (int x = 0; x < map.width; ++x)
            visit(glm::dvec3(glm::make_vec3(map.at(x, y))), solidAngle,
                  texelDirection<double>(x, y, map.width, map.height));
    }
}

// Coefficients or values by index; Y_lm has the index l (l + 1) + m.
using ShBasis = std::array<double, kShCount>;
using ShRgb = std::array<glm::dvec3, kShCount>;

// Returns all Y_lm in one direction (unit length, z the polar axis of the harmonics). Signs as in Ramamoorthi
// and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", eq. 3: without the
// Condon-Shortley phase.
ShBasis shBasis(const glm::dvec3& dir);

// Constant factors of bands 0 to 2: Y_lm is its factor times 1; y, z, x; xy, yz, 3z^2 - 1, xz, x^2 - y^2.
extern const std::array<double, 9> kShFactors;

// Returns the integrals of radiance times Y_lm over the sphere (their eq. 2); texels are sampled at their
// centres, with exact solid angles.
ShRgb shProject(const ImageRgbF& radianceLin);

// Factors A_l that turn radiance into irradiance, by band: pi, 2 pi / 3, pi / 4, 0, -pi / 24 (their eq. 8 and
// 9).
extern const std::array<double, kShBands> kShCosine;

} // namespace shoal::math
