// The GGX microfacet BRDF's factors, as the textbooks have them: what tables and lobes are held against. nh =
// n.h, nl = n.l, nv = n.v, cosines of unit vectors; alpha = roughness^2.
#pragma once

#include <cmath>
#include <numbers>

namespace shoal::math {

// Trowbridge-Reitz (GGX) distribution of normals, per steradian; its integral times n.h over the hemisphere
// is 1. Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33.
inline double ggxD(double nh, double alpha) {
    const double alpha2 = alpha * alpha;
    const double q = nh * nh * (alpha2 - 1.0) + 1.0;
    return alpha2 / (std::numbers::pi * q * q);
}

// G / (4 nl nv) with Smith's height-correlated masking and shadowing. Heitz 2014, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 99. 0 where nl or nv is not above 0.
inline double smithV(double nl, double nv, double alpha) {
    if (nl <= 0 || nv <= 0) return 0;
    const double alpha2 = alpha * alpha;
    const double lightTerm = nv * std::sqrt(nl * nl * (1.0 - alpha2) + alpha2);
    const double viewTerm = nl * std::sqrt(nv * nv * (1.0 - alpha2) + alpha2);
    return 0.5 / (lightTerm + viewTerm);
}

} // namespace shoal::math
