// Sets what grows on the ground.
#pragma once

#include "content/make/video/Mesh.h"
#include "content/make/video/Route.h"

namespace shoal::reef {

struct Grown {
    Mesh still, swaying;
};
// ground: vertices to grow on; sunlit: the sun's share at a place of it.
Grown grow(const Scene& scene, const Route& route, const Mesh& ground,
           const std::function<float(const vec3&)>& sunlit);

} // namespace shoal::reef
