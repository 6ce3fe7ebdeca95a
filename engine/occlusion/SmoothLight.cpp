#include "engine/occlusion/SmoothLight.h"

#include "engine/math/SphericalHarmonics.h"
#include "engine/occlusion/Directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::occlusion {

using math::eachTexel;

namespace {

constexpr double kBright = 2;  // times the mean luminance; brighter light belongs to the dominant light
constexpr double kReach = 0.7; // cosine of the angle beyond which texels do not belong to the dominant light
constexpr double kMin = 0.004; // least sin^2 of the half angle: the resolution of a small map

double luminance(const glm::dvec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; } // Rec. 709

constexpr float kRows[][3] = {
#define AXES(row, x, y, z) {x##f, y##f, z##f},
#include "shaders/occlusion/Axes.glsl"
#undef AXES
};
static_assert(4 * std::size(kRows) == kAxisCount);

std::array<glm::vec3, kAxisCount> readAxes() {
    std::array<glm::vec3, kAxisCount> axes;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float* row = kRows[k / 4];
        axes[k] = glm::normalize(glm::vec3(row[0], k & 2 ? -row[1] : row[1], k & 1 ? -row[2] : row[2]));
    }
    return axes;
}

// Sums the map's light, distributing each texel over the nearby ends of the axes.
class Spread {
  public:
    void add(const glm::dvec3& d, double solidAngle, const glm::dvec3& radiance) {
        std::array<double, 2 * kAxisCount> shares{};
        double sum = 0;
        for (size_t k = 0; k < shares.size(); ++k) {
            const double along = glm::dot(d, glm::dvec3(kAxes[k % kAxisCount]));
            const double apart2 = (2 - 2 * (k < kAxisCount ? along : -along)) / kCell2;
            if (apart2 <= 4) sum += shares[k] = std::exp(-2 * apart2);
        }
        for (size_t k = 0; k < shares.size(); ++k) {
            const double weight = solidAngle * shares[k] / sum;
            sums_[k] += weight * radiance;
            weights_[k] += weight;
        }
    }
    glm::vec3 radiance(size_t k) const { return glm::vec3(sums_[k] / std::max(weights_[k], 1e-9)); }

  private:
    static constexpr double kCell2 = 2.0 / kAxisCount; // squared radius of each axis end's cell
    std::array<glm::dvec3, 2 * kAxisCount> sums_{};
    std::array<double, 2 * kAxisCount> weights_{};
};

} // namespace

const std::array<glm::vec3, kAxisCount> kAxes = readAxes();

SmoothLight smoothLight(const ImageRgbF& radianceLin) {
    SmoothLight light;
    double mean = 0;
    eachTexel(radianceLin, [&](const glm::dvec3& radiance, double solidAngle, const glm::dvec3&) {
        mean += solidAngle * luminance(radiance) / (4 * std::numbers::pi);
    });
    const auto excess = [&](const glm::dvec3& radiance) {
        return std::max(luminance(radiance) - kBright * mean, 0.0);
    };
    // Squares let the strongest of several dominant lights win.
    glm::dvec3 brightest(0);
    eachTexel(radianceLin, [&](const glm::dvec3& radiance, double solidAngle, const glm::dvec3& dir) {
        brightest += solidAngle * excess(radiance) * excess(radiance) * dir;
    });
    const bool even = glm::dot(brightest, brightest) <= 0;
    if (!even) brightest = glm::normalize(brightest);
    Spread rest;
    std::array<glm::dvec3, 4> smooth{};
    glm::dvec3 flux(0), centre(0);
    double weight = 0;
    eachTexel(radianceLin, [&](const glm::dvec3& radiance, double solidAngle, const glm::dvec3& dir) {
        const double near =
            even ? 0 : std::clamp((glm::dot(dir, brightest) - kReach) / (0.5 * (1 - kReach)), 0.0, 1.0);
        const double bright = near * excess(radiance), share = bright / std::max(luminance(radiance), 1e-9);
        const glm::dvec3 all = solidAngle * radiance;
        rest.add(dir, solidAngle, (1 - share) * radiance);
        smooth[0] += all / (4 * std::numbers::pi);
        for (int k = 0; k < 3; ++k) smooth[k + 1] += 3 * dir[k] / (4 * std::numbers::pi) * all;
        flux += share * all;
        weight += solidAngle * bright;
        centre += solidAngle * bright * dir;
    });
    for (size_t k = 0; k < kAxisCount; ++k)
        light.ahead[k] = rest.radiance(k), light.behind[k] = rest.radiance(kAxisCount + k);
    for (size_t k = 0; k < 4; ++k) light.even[k] = glm::vec3(smooth[k]);
    if (weight <= 0) return light;
    // The mean direction of a cap has the length (1 + cos) / 2.
    const double cosine = std::clamp(2 * glm::length(centre) / weight - 1, 0.0, std::sqrt(1 - kMin));
    light.dominantTowards = glm::vec3(glm::normalize(centre));
    light.dominantShare = static_cast<float>(1 - cosine * cosine);
    light.dominantRadiance = glm::vec3(flux / (2 * std::numbers::pi * (1 - cosine)));
    return light;
}

glm::mat4x3 dominantDirections(const SmoothLight& light) {
    const glm::mat3 dominantFromAside = frameAround(light.dominantTowards);
    const float aside = std::sqrt(light.dominantShare / 2), ahead = std::sqrt(1 - light.dominantShare / 2);
    glm::mat4x3 directions;
    for (int k = 0; k < 4; ++k) {
        const float turn = static_cast<float>(std::numbers::pi / 2) * static_cast<float>(k);
        directions[k] = dominantFromAside * glm::vec3(aside * std::cos(turn), aside * std::sin(turn), ahead);
    }
    return directions;
}

} // namespace shoal::occlusion
