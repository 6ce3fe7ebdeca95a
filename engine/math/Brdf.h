// Reflectance of surfaces: lobes of GGX and Phong, and the split sum's second factor. They make tables, so
// they compute in double precision.
#pragma once

#include <numbers>
#include <vector>

namespace shoal::math {

inline double alphaFromRoughness(double roughness) { return roughness * roughness; }

// Returns the lobe around the mirror direction for n = v = r, not normalised: D(h) max(0, cosine), cosine =
// r.l, where D is the Trowbridge-Reitz (GGX) distribution of normals and h lies half way. Karis 2013, "Real
// Shading in Unreal Engine 4": his prefiltering weighs GGX samples by n.l, and with n = v their density is D
// / 4. alpha = 1 gives the clamped cosine.
inline double ggxMirrorLobe(double cosine, double alpha) {
    // nh^2 = cos^2(angle / 2) = (1 + cosine) / 2, so that nothing cancels at the peak of a narrow lobe.
    const double alpha2 = alpha * alpha;
    const double q = (1.0 - cosine) * 0.5 + alpha2 * (1.0 + cosine) * 0.5;
    return alpha2 / (std::numbers::pi * q * q) * (cosine > 0 ? cosine : 0);
}

// Returns the exponent of the Phong lobe that is as wide as ggxMirrorLobe: alpha = 1 gives 1, both being the
// cosine; small alpha gives 1 / (2 alpha^2), as cos(t) ~ cos(t / 2)^4 turns Blinn's exponent 2 / alpha^2 into
// Phong's.
double phongExponentFromRoughness(double roughness);

// Split sum, second factor (Karis 2013): a surface reflects f0 * scale + bias of a white environment. scale +
// bias is the albedo for f0 = 1; the rest to 1 is scattered again between microfacets, see Fdez-Aguera 2019,
// "A Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting".
struct Dfg {
    double scale = 0;
    double bias = 0;
};
// Integrates numerically over visible normals; nv in (0, 1].
Dfg dfg(double nv, double roughness);

// Returns a table for a texture of size x size with two channels, sampled linearly and clamped. Texel (x, y)
// holds scale and bias at nv = (x + 0.5) / size, roughness = (y + 0.5) / size.
std::vector<float> makeDfgTable(int size);

} // namespace shoal::math
