#include "engine/math/SphericalHarmonics.h"

#include <cmath>
#include <numbers>

namespace shoal::math {

using std::numbers::pi;

static double root(double square) { return std::sqrt(square / pi); }

const std::array<double, kShBands> kShCosine = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24};
const std::array<double, 9> kShFactors = {root(1.0 / 4),  root(3.0 / 4),  root(3.0 / 4),
                                          root(3.0 / 4),  root(15.0 / 4), root(15.0 / 4),
                                          root(5.0 / 16), root(15.0 / 4), root(15.0 / 16)};

// Cartesian forms, e.g. Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", appendix A2.
ShBasis shBasis(const glm::dvec3& dir) {
    const double x = dir.x, y = dir.y, z = dir.z;
    const double x2 = x * x, y2 = y * y, z2 = z * z;
    const auto& k = kShFactors;
    static const double k33 = root(35.0 / 32), k32 = root(105.0 / 4), k31 = root(21.0 / 32),
                        k30 = root(7.0 / 16);
    static const double k322 = root(105.0 / 16), k44 = root(315.0 / 16), k43 = root(315.0 / 32),
                        k42 = root(45.0 / 16);
    static const double k41 = root(45.0 / 32), k40 = root(9.0 / 256), k422 = root(45.0 / 64),
                        k444 = root(315.0 / 256);
    return {
        k[0],
        k[1] * y,
        k[2] * z,
        k[3] * x,
        k[4] * x * y,
        k[5] * y * z,
        k[6] * (3 * z2 - 1),
        k[7] * x * z,
        k[8] * (x2 - y2),
        k33 * y * (3 * x2 - y2),
        k32 * x * y * z,
        k31 * y * (5 * z2 - 1),
        k30 * z * (5 * z2 - 3),
        k31 * x * (5 * z2 - 1),
        k322 * z * (x2 - y2),
        k33 * x * (x2 - 3 * y2),
        k44 * x * y * (x2 - y2),
        k43 * y * z * (3 * x2 - y2),
        k42 * x * y * (7 * z2 - 1),
        k41 * y * z * (7 * z2 - 3),
        k40 * (35 * z2 * z2 - 30 * z2 + 3),
        k41 * x * z * (7 * z2 - 3),
        k422 * (x2 - y2) * (7 * z2 - 1),
        k43 * x * z * (x2 - 3 * y2),
        k444 * (x2 * x2 - 6 * x2 * y2 + y2 * y2),
    };
}

ShRgb shProject(const ImageRgbF& radianceLin) {
    ShRgb result{};
    eachTexel(radianceLin, [&](const glm::dvec3& radiance, double solidAngle, const glm::dvec3& dir) {
        const ShBasis basis = shBasis(dir);
        const glm::dvec3 power = radiance * solidAngle;
        for (size_t i = 0; i < basis.size(); ++i) result[i] += power * basis[i];
    });
    return result;
}

} // namespace shoal::math
