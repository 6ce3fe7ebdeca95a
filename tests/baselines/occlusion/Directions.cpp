#include "tests/baselines/occlusion/Directions.h"

#include "engine/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>

namespace shoal::occlusion::baselines {

std::vector<glm::vec3> evenDirections(int count) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < count; ++i) {
        const float y = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
        const float ring = std::sqrt(1 - y * y), turn = static_cast<float>(i * kGoldenAngle);
        out.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    return out;
}

DirectedLight directedLight(const ImageRgbF& image, std::vector<glm::vec3> directions) {
    DirectedLight light{std::move(directions), {}};
    std::vector<glm::dvec3> sums(light.directions.size());
    math::eachTexel(image, [&](const glm::dvec3& radiance, double solidAngle, const glm::vec3& to) {
        const auto nearest = std::ranges::max_element(light.directions, {},
                                                      [&](const glm::vec3& d) { return glm::dot(d, to); });
        sums[nearest - light.directions.begin()] += solidAngle * radiance;
    });
    light.power.assign(sums.begin(), sums.end());
    return light;
}

} // namespace shoal::occlusion::baselines
