// Radiance and diffuse light out of spherical harmonics (engine/math/SphericalHarmonics.h).
#pragma once

#include "engine/math/SphericalHarmonics.h"

#include <cassert>
#include <numbers>

namespace shoal::math {

// Sum of coefficients times Y_lm; bands: how many to use, 1 to kShBands.
inline glm::dvec3 shEvaluate(const ShRgb& coefficients, const glm::dvec3& dir, int bands = kShBands) {
    assert(bands >= 1 && bands <= kShBands);
    const ShBasis basis = shBasis(dir);
    glm::dvec3 sum(0);
    for (size_t i = 0; i < static_cast<size_t>(bands) * bands; ++i) sum += coefficients[i] * basis[i];
    return sum;
}

// Radiance leaving a white matte surface by its normal: irradiance / pi. bands = 3: the nine coefficients of
// Ramamoorthi and Hanrahan 2001.
inline glm::dvec3 shDiffuseRadiance(const ShRgb& radiance, const glm::dvec3& normal, int bands = 3) {
    ShRgb diffuse = radiance;
    for (size_t l = 0; l < kShBands; ++l)
        for (size_t i = l * l; i < (l + 1) * (l + 1); ++i) diffuse[i] *= kShCosine[l] / std::numbers::pi;
    return shEvaluate(diffuse, normal, bands);
}

} // namespace shoal::math
