#include "engine/occlusion/SmoothLight.h"

#include "engine/math/LatLong.h"

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

// Mean over the sphere of radiance times polynomials, each divided by the mean of its own square.
struct Projection {
    std::array<glm::dvec3, 9> sums{};

    void add(const glm::dvec3& d, const glm::dvec3& flux) {
        const double a = d.y * d.y - 1 / 3.0, b = d.x * d.x - d.z * d.z;
        const std::array<double, 9> terms = {
            1,         3 * d.x, 3 * d.y, 3 * d.z, 15 * d.x * d.y, 15 * d.y * d.z, 15 * d.x * d.z,
            11.25 * a, 3.75 * b};
        for (size_t k = 0; k < terms.size(); ++k) sums[k] += terms[k] / (4 * std::numbers::pi) * flux;
    }
    std::array<glm::vec3, 9> factors() const {
        std::array<glm::vec3, 9> result;
        for (size_t k = 0; k < result.size(); ++k) result[k] = glm::vec3(sums[k]);
        return result;
    }
};

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
    const bool even = glm::dot(brightest, brightest) <= 0;
    if (!even) brightest = glm::normalize(brightest);
    Projection rest;
    glm::dvec3 flux(0), centre(0);
    double weight = 0;
    eachTexel(radianceLin, [&](int x, int y, double solidAngle, const glm::dvec3& dir) {
        const double near =
            even ? 0 : std::clamp((glm::dot(dir, brightest) - kReach) / (0.5 * (1 - kReach)), 0.0, 1.0);
        const float* texel = radianceLin.at(x, y);
        const double bright = near * excess(x, y), share = bright / std::max(luminance(texel), 1e-9);
        const glm::dvec3 all = solidAngle * glm::dvec3(texel[0], texel[1], texel[2]);
        rest.add(dir, (1 - share) * all);
        flux += share * all;
        weight += solidAngle * bright;
        centre += solidAngle * bright * dir;
    });
    light.around = rest.factors();
    if (weight <= 0) return light;
    // A cap's mean direction is (1 + cos) / 2 long.
    const double cosine = std::clamp(2 * glm::length(centre) / weight - 1, 0.0, std::sqrt(1 - kLeast));
    light.lampTowards = glm::vec3(glm::normalize(centre));
    light.lampShare = static_cast<float>(1 - cosine * cosine);
    light.lampRadiance = glm::vec3(flux / (2 * std::numbers::pi * (1 - cosine)));
    return light;
}

SmoothLight turned(const SmoothLight& light, const glm::mat3& thereFromHere) {
    SmoothLight out = light;
    out.lampTowards = thereFromHere * light.lampTowards;
    const glm::mat3 back = glm::transpose(thereFromHere);
    const auto& f = light.around;
    for (int c = 0; c < 3; ++c) {
        const glm::vec3 slope = thereFromHere * glm::vec3(f[1][c], f[2][c], f[3][c]);
        const float xy = f[4][c] / 2, yz = f[5][c] / 2, xz = f[6][c] / 2, a = f[7][c], b = f[8][c];
        const glm::mat3 bend =
            thereFromHere * glm::mat3(b - a / 3, xy, xz, xy, 2 * a / 3, yz, xz, yz, -b - a / 3) * back;
        const float terms[8] = {
            slope.x,        slope.y,        slope.z,           2 * bend[0][1],
            2 * bend[1][2], 2 * bend[0][2], 1.5f * bend[1][1], (bend[0][0] - bend[2][2]) / 2};
        for (size_t k = 0; k < 8; ++k) out.around[k + 1][c] = terms[k];
    }
    return out;
}

} // namespace shoal::occlusion
