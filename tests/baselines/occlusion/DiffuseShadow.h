// Shadows in diffuse light: how much of the half sphere over a place is free.
#pragma once

#include "engine/occlusion/Directions.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <algorithm>
#include <vector>

namespace shoal::occlusion {

// Directions spread evenly over the sphere, the same for all receivers: a direction counts with the cosine to
// the normal, so that nothing jumps where normals turn.
class ShadowRays {
  public:
    // count: over the whole sphere; even. The error of an open half sphere's weight is some 0.6 / count.
    explicit ShadowRays(int count) : directions_(Axes(count / 2).axes) {
        const size_t half = directions_.size();
        directions_.reserve(2 * half);
        for (size_t i = 0; i < half; ++i) directions_.push_back(-directions_[i]);
    }

    // Mean of radiance(direction) over the half sphere around `normal`, weighed with the cosine, where the
    // method meets nothing beyond `nearest`: irradiance over pi. Body frame; Radiance: (const glm::vec3&) ->
    // T with T{}, +, *.
    template <TracesRays Method, class Radiance>
    auto gather(const Method& method, const glm::vec3& place, const glm::vec3& normal, float nearest,
                Radiance&& radiance) const {
        decltype(radiance(normal) * 1.0f) sum{};
        float all = 0;
        for (const glm::vec3& direction : directions_) {
            const float cosine = glm::dot(direction, normal);
            if (cosine <= 0) continue;
            all += cosine;
            if (!method.trace(place, direction, nearest)) sum = sum + radiance(direction) * cosine;
        }
        return all > 0 ? sum * (1 / all) : sum;
    }

    // Share of an even sky that reaches the place: 1 in the open.
    template <TracesRays Method>
    float visibility(const Method& method, const glm::vec3& place, const glm::vec3& normal,
                     float nearest) const {
        return gather(method, place, normal, nearest, [](const glm::vec3&) { return 1.0f; });
    }

  private:
    std::vector<glm::vec3> directions_;
};

} // namespace shoal::occlusion
