#include "tests/baselines/occlusion/Directions.h"

#include "engine/math/LatLong.h"

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
    for (int y = 0; y < image.height; ++y) {
        const double solidAngle = texelSolidAngle(y, image.width, image.height);
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 to = texelDirection(x, y, image.width, image.height);
            const auto nearest = std::ranges::max_element(
                light.directions, {}, [&](const glm::vec3& d) { return glm::dot(d, to); });
            const float* texel = image.at(x, y);
            sums[nearest - light.directions.begin()] += solidAngle * glm::dvec3(texel[0], texel[1], texel[2]);
        }
    }
    light.power.assign(sums.begin(), sums.end());
    return light;
}

} // namespace shoal::occlusion::baselines
