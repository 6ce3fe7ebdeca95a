#include "engine/math/Brdf.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace shoal::math {

using std::numbers::pi;

double phongExponentFromRoughness(double roughness) {
    const double alpha = std::max(alphaFromRoughness(roughness), 1e-4);
    return 0.5 / (alpha * alpha) + 0.5;
}

// Sampling normals that are visible from v, the estimator of the albedo is F G2 / G1 (Heitz 2018, "Sampling
// the GGX Distribution of Visible Normals", eq. 19). The normals come from a uniform spherical cap around the
// stretched view: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
Dfg dfg(double nv, double roughness) {
    assert(nv > 0 && nv <= 1);
    constexpr int kSamples = 24; // midpoints in each direction
    const double alpha = std::max(alphaFromRoughness(roughness), 1e-4);
    const double sinV = std::sqrt(std::max(0.0, 1.0 - nv * nv));
    const double stretched = std::sqrt(alpha * alpha * sinV * sinV + nv * nv);
    const double wx = alpha * sinV / stretched, wz = nv / stretched;
    const auto lambda = [&](double c) {
        return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)) - 1.0);
    };
    const double lambdaV = lambda(nv);

    std::vector<double> cosines, sines; // of the azimuth, over half a circle: the other half is symmetric
    for (int i = 0; i < kSamples; ++i) {
        cosines.push_back(std::cos(pi * (i + 0.5) / kSamples));
        sines.push_back(std::sin(pi * (i + 0.5) / kSamples));
    }
    Dfg sum;
    for (int j = 0; j < kSamples; ++j) {
        // Midpoints of s in share = s^2: masking and the horizon cut the lobe's thin tail, near share 0.
        const double s = (j + 0.5) / kSamples;
        const double cz = s * s * (1.0 + wz) - wz, part = 2.0 * s;
        const double cr = std::sqrt(std::max(0.0, 1.0 - cz * cz));
        for (size_t i = 0; i < cosines.size(); ++i) {
            double hx = alpha * (cr * cosines[i] + wx), hy = alpha * cr * sines[i], hz = cz + wz;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length, hz /= length;
            const double vh = sinV * hx + nv * hz;
            const double nl = 2.0 * vh * hz - nv;
            if (nl <= 0 || vh <= 0) continue;
            const double visible = part * (1.0 + lambdaV) / (1.0 + lambdaV + lambda(std::min(nl, 1.0)));
            const double away = 1.0 - std::min(vh, 1.0), away2 = away * away;
            const double fresnel = away2 * away2 * away; // std::pow would take as long as everything else
            sum.scale += (1.0 - fresnel) * visible;
            sum.bias += fresnel * visible;
        }
    }
    const double count = static_cast<double>(kSamples) * kSamples;
    return {sum.scale / count, sum.bias / count};
}

std::vector<float> makeDfgTable(int size) {
    assert(size > 0);
    std::vector<float> table;
    table.reserve(static_cast<size_t>(size) * size * 2);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Dfg factor = dfg((x + 0.5) / size, (y + 0.5) / size);
            table.insert(table.end(), {static_cast<float>(factor.scale), static_cast<float>(factor.bias)});
        }
    return table;
}

} // namespace shoal::math
