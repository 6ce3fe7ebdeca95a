#include "engine/light/PhongRings.h"

#include "engine/light/Lookup.h"
#include "engine/math/Brdf.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::light {

using std::numbers::pi;

// The lobe cos(t)^n has the share cos(t)^(n + 1) of its energy outside the angle t. It is half its peak at
// cos(t) = 2^(-1/n), so the share 2^-((n + 1) / n) of the energy lies outside that angle.
std::array<PhongRing, kPhongRings> phongRings(double roughness) {
    const double exponent = math::phongExponentFromRoughness(roughness);
    const double outside = std::exp2(-(exponent + 1) / exponent);
    std::array<PhongRing, kPhongRings> rings;
    for (int i = 0; i < kPhongRings; ++i) {
        const double part = (i % 3 + 0.5) / 3;
        const double left = i < 3 ? 1 - part * (1 - outside) : (1 - part) * outside;
        rings[static_cast<size_t>(i)] = {std::acos(std::pow(left, 1 / (exponent + 1))),
                                         (i < 3 ? 1 - outside : outside) / 3};
    }
    return rings;
}

glm::vec3 phongRingsRadiance(const RadiancePyramid& pyramid, const glm::vec3& mirror, double roughness) {
    const glm::vec3 helper = std::abs(mirror.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 side = glm::normalize(glm::cross(mirror, helper));
    const glm::vec3 up = glm::cross(side, mirror);
    const auto rings = phongRings(roughness);
    glm::vec3 sum(0);
    for (size_t r = 0; r < rings.size(); ++r) {
        const double angle = rings[r].angle;
        const double spacing = std::max(2 * pi * std::sin(angle) / kSamplesPerRing, 1e-4);
        const double lod = std::max(0.0, std::log2(spacing * pyramid.levels[0].width / (2 * pi)));
        glm::vec3 ring(0);
        for (int i = 0; i < kSamplesPerRing; ++i) {
            const double turn = (i + (r % 2 ? 0.5 : 0.0)) * (2 * pi / kSamplesPerRing);
            const glm::vec3 aside =
                side * static_cast<float>(std::cos(turn)) + up * static_cast<float>(std::sin(turn));
            const glm::vec3 dir =
                mirror * static_cast<float>(std::cos(angle)) + aside * static_cast<float>(std::sin(angle));
            ring += lookUp(pyramid, dir, static_cast<float>(lod));
        }
        sum += ring * static_cast<float>(rings[r].weight / kSamplesPerRing);
    }
    return sum;
}

} // namespace shoal::light
