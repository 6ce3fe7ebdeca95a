// Rays between mirrors that show themselves.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

namespace shoal::occlusion {

// A ray after its bounces, and their number.
struct Reflected {
    glm::vec3 origin{0}, direction{0, 0, 1}; // the last ray, which meets nothing unless `caught`
    int bounces = 0;
    bool caught = false; // it still meets a surface after the last bounce allowed
};

// Follows a ray from mirror to mirror, at most `most` bounces. Body frame, metres; direction unit; each ray
// begins beyond `nearest`.
template <TracesRays Method>
Reflected followMirrors(const Method& method, glm::vec3 origin, glm::vec3 direction, float nearest,
                        int maximum) {
    Reflected ray{origin, direction, 0, false};
    for (;;) {
        const auto hit = method.trace(ray.origin, ray.direction, nearest);
        if (!hit) return ray;
        if (ray.bounces == maximum) {
            ray.caught = true;
            return ray;
        }
        ray.origin += hit->distance * ray.direction;
        ray.direction = glm::normalize(glm::reflect(ray.direction, hit->normal));
        ++ray.bounces;
    }
}

} // namespace shoal::occlusion
