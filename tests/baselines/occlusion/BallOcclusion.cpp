#include "tests/baselines/occlusion/BallOcclusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::occlusion::baselines {

float sphereOcclusion(const glm::vec3& normal, const glm::vec3& toSphere, float radius) {
    const float square = std::max(glm::dot(toSphere, toSphere) / (radius * radius), 1.0f + 1e-5f);
    const float cosine = glm::dot(normal, toSphere) / glm::length(toSphere);
    const float sine2 = 1 / square;                 // of the sphere's angular radius
    const float cut = 1 - square * cosine * cosine; // above 0: the horizon cuts the sphere
    if (cut <= 0) return cosine > 0 ? cosine * sine2 : 0;
    const float reach = std::sqrt(square - 1);
    const float side =
        std::clamp(-cosine * reach / std::sqrt(std::max(1 - cosine * cosine, 1e-12f)), -1.0f, 1.0f);
    const float lit =
        (cosine * std::acos(side) - std::sqrt(cut) * reach) * sine2 + std::atan(std::sqrt(cut) / reach);
    return std::max(0.0f, lit * std::numbers::inv_pi_v<float>);
}

} // namespace shoal::occlusion::baselines
