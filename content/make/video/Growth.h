// Placement of the corals and plants that grow on the ground.
#pragma once

#include "content/make/video/Mesh.h"
#include "content/make/video/Route.h"

namespace shoal::reef {

struct Grown {
    Mesh still, swaying;
};
// ground: its vertices are the places to grow on; sunlit: returns the share of sunlight at such a place.
Grown grow(const Scene& scene, const Route& route, const Mesh& ground,
           const std::function<float(const vec3&)>& sunlit);

} // namespace shoal::reef
