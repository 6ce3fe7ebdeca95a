// What a mirror shows that shows itself.
#pragma once

#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// The direction in which a ray leaves after at most `most` bounces off mirrors; after the last it is let
// through.
template <occlusion::TracesRays Method>
glm::vec3 leaving(const Method& method, glm::vec3 origin, glm::vec3 direction, float nearest, int most) {
    for (int bounce = 0; bounce < most; ++bounce) {
        const auto hit = method.trace(origin, direction, nearest);
        if (!hit) break;
        origin += hit->distance * direction;
        direction = glm::normalize(glm::reflect(direction, hit->normal));
    }
    return direction;
}

} // namespace shoal::bench
