// Level ground below the film's camera, and a light above it.
#pragma once

#include "engine/render/CastShadow.h"
#include "tests/unit/depth/MadeMap.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::tests {

constexpr float kGround_m = -1.25f;

inline depth::DepthMap levelGround(float height_m = kGround_m) {
    return depth::mapOf([&](const glm::vec3& dir) { return std::max(dir.y / height_m, 0.0f); });
}

inline depth::DepthRange rangeOf(const depth::DepthMap& map) {
    depth::DepthRange range;
    range.make(map);
    return range;
}

// Returns the depth map of a camera at the world's origin; distance_m: distance of the solid in a direction.
template <class Distance> depth::DepthMap filmOf(const Distance& distance_m) {
    return depth::mapOf([&](const glm::vec3& dir) { return 1 / distance_m(dir); });
}

inline float toPlane(const glm::vec3& dir, const glm::vec3& normal, float distance_m) {
    const float towards = -glm::dot(dir, normal);
    return towards > 1e-4f ? distance_m / towards : INFINITY;
}

// Returns a light in a direction whose azimuth is not along an axis.
inline render::CastingLight lightAt(float elevation_deg, float radius_deg) {
    const float e = glm::radians(elevation_deg);
    return {.towards = {0.3f * std::cos(e), std::sin(e), std::sqrt(0.91f) * std::cos(e)},
            .tangent = std::tan(glm::radians(radius_deg)),
            .share = glm::vec3(0.4f, 0.35f, 0.3f)};
}

// Returns the share of the light's solid angle that is blocked; blocked: (unit direction) -> bool.
template <class Blocked>
float hiddenByRays(const render::CastingLight& light, int rays, const Blocked& blocked) {
    const glm::vec3 side = glm::normalize(glm::cross(light.towards, glm::vec3(0.1f, 0.2f, 0.9f)));
    const glm::vec3 up = glm::cross(side, light.towards);
    const float cosine = 1 / std::sqrt(1 + light.tangent * light.tangent);
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
        const float z = 1 - (1 - cosine) * (static_cast<float>(i) + 0.5f) / static_cast<float>(rays);
        const float turn = static_cast<float>(i) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
        const float ring = std::sqrt(1 - z * z);
        hits += blocked(z * light.towards + ring * (std::cos(turn) * side + std::sin(turn) * up));
    }
    return static_cast<float>(hits) / static_cast<float>(rays);
}

} // namespace shoal::tests
