#include "engine/occlusion/SmoothLight.h"

#include "engine/math/LatLong.h"
#include "engine/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::occlusion {

namespace {

constexpr double kBright = 2;    // times the mean luminance: what lies above belongs to the lamp
constexpr double kReach = 0.7;   // cosine at which texels cease to be the lamp's
constexpr double kLeast = 0.004; // sin^2 of half angle: what texels of a small map can tell

double luminance(const float* rgb) {
    return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
           0.0722 * static_cast<double>(rgb[2]);
}

template <class Visit> void eachTexel(const ImageRgbF& map, Visit&& visit) {
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = texelSolidAngle(y, map.width, map.height);
        for (int x = 0; x < map.width; ++x)
            visit(x, y, solidAngle,
                  directionFromLatLong(glm::dvec2((x + 0.5) / map.width, (y + 0.5) / map.height)));
    }
}

std::array<glm::vec3, 9> polynomials(const ImageRgbF& map) {
    const math::ShRgb sh = math::shProject(map);
    const auto k = [](double square) { return std::sqrt(square / std::numbers::pi); };
    // With a = y^2 - 1/3 and b = x^2 - z^2: 3 z^2 - 1 = -1.5 (a + b), x^2 - y^2 = -1.5 a + 0.5 b.
    const glm::dvec3 z2 = k(5.0 / 16) * sh[6], xy2 = k(15.0 / 16) * sh[8];
    return {glm::vec3(k(1.0 / 4) * sh[0]),  glm::vec3(k(3.0 / 4) * sh[3]),  glm::vec3(k(3.0 / 4) * sh[1]),
            glm::vec3(k(3.0 / 4) * sh[2]),  glm::vec3(k(15.0 / 4) * sh[4]), glm::vec3(k(15.0 / 4) * sh[5]),
            glm::vec3(k(15.0 / 4) * sh[7]), glm::vec3(-1.5 * (z2 + xy2)),   glm::vec3(-1.5 * z2 + 0.5 * xy2)};
}

} // namespace

SmoothLight smoothLight(const ImageRgbF& radianceLin) {
    SmoothLight light;
    double mean = 0;
    eachTexel(radianceLin, [&](int x, int y, double solidAngle, const glm::dvec3&) {
        mean += solidAngle * luminance(radianceLin.at(x, y)) / (4 * std::numbers::pi);
    });
    const auto excess = [&](int x, int y) {
        return std::max(luminance(radianceLin.at(x, y)) - kBright * mean, 0.0);
    };
    // Where it is brightest: squares let the strongest of several lamps win.
    glm::dvec3 brightest(0);
    eachTexel(radianceLin, [&](int x, int y, double solidAngle, const glm::dvec3& dir) {
        brightest += solidAngle * excess(x, y) * excess(x, y) * dir;
    });
    if (glm::dot(brightest, brightest) <= 0) {
        light.around = polynomials(radianceLin);
        return light;
    }
    brightest = glm::normalize(brightest);
    ImageRgbF rest = radianceLin;
    glm::dvec3 flux(0), centre(0);
    double weight = 0;
    eachTexel(radianceLin, [&](int x, int y, double solidAngle, const glm::dvec3& dir) {
        const double near = std::clamp((glm::dot(dir, brightest) - kReach) / (0.5 * (1 - kReach)), 0.0, 1.0);
        const float* texel = radianceLin.at(x, y);
        const double share = near * excess(x, y) / std::max(luminance(texel), 1e-9);
        for (int c = 0; c < 3; ++c) {
            rest.at(x, y)[c] -= static_cast<float>(share) * texel[c];
            flux[c] += solidAngle * share * static_cast<double>(texel[c]);
        }
        weight += solidAngle * near * excess(x, y);
        centre += solidAngle * near * excess(x, y) * dir;
    });
    light.around = polynomials(rest);
    if (weight <= 0) return light;
    // A cap's mean direction is (1 + cos) / 2 long.
    const double cosine = std::clamp(2 * glm::length(centre) / weight - 1, 0.0, std::sqrt(1 - kLeast));
    light.lampTowards = glm::vec3(glm::normalize(centre));
    light.lampShare = static_cast<float>(1 - cosine * cosine);
    light.lampRadiance = glm::vec3(flux / (2 * std::numbers::pi * (1 - cosine)));
    return light;
}

} // namespace shoal::occlusion
