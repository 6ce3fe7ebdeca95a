// Radiance out of spherical harmonics (engine/math/SphericalHarmonics.h).
#pragma once

#include "engine/math/SphericalHarmonics.h"

#include <cassert>

namespace shoal::math {

// Sum of coefficients times Y_lm; bands: how many to use, 1 to kShBands.
inline glm::dvec3 shEvaluate(const ShRgb& coefficients, const glm::dvec3& dir, int bands = kShBands) {
    assert(bands >= 1 && bands <= kShBands);
    const ShBasis basis = shBasis(dir);
    glm::dvec3 sum(0);
    for (size_t i = 0; i < static_cast<size_t>(bands) * bands; ++i) sum += coefficients[i] * basis[i];
    return sum;
}

} // namespace shoal::math
