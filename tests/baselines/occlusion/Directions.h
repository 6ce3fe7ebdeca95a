// An environment as few directions: what methods use that ask, ray by ray, from where a point is seen.
#pragma once

#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/core/Image.h"
#include "engine/occlusion/Directions.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace shoal::occlusion::baselines {

// Whether anything stands in a ray's way; unit direction.
using Occluded = std::function<bool(const glm::vec3& origin, const glm::vec3& direction)>;

// Spread evenly over the sphere: Fibonacci lattice.
std::vector<glm::vec3> evenDirections(int count);

// Radiance from every direction, shared out to the nearest of these: its integral over each one's part of the
// sphere.
struct DirectedLight {
    std::vector<glm::vec3> directions, power; // power: radiance times solid angle
};
DirectedLight directedLight(const ImageRgbF& radianceLin, std::vector<glm::vec3> directions);

// Share of the diffuse light that is left when only some directions are seen, by colour; seen(k): whether.
template <class Seen>
glm::vec3 shareSeen(const DirectedLight& light, const glm::vec3& normal, const Seen& seen) {
    glm::vec3 left(0), whole(1e-20f);
    for (size_t k = 0; k < light.directions.size(); ++k) {
        const float cosine = glm::dot(light.directions[k], normal);
        if (cosine <= 0) continue;
        const glm::vec3 power = cosine * light.power[k];
        whole += power;
        if (seen(k)) left += power;
    }
    return left / whole;
}

} // namespace shoal::occlusion::baselines
