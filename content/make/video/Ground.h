// Meshes of sand and rock, on which everything else grows.
#pragma once

#include "content/make/video/Mesh.h"

namespace shoal::reef {

float sandHeight(const Scene& scene, const vec2& xz);
Mesh makeSand(const Scene& scene);
// Surface nets (Gibson 1998) over the group's signed distances, with its colours by place and slope.
Mesh makeRock(const Scene& scene, const Rock& rock);

} // namespace shoal::reef
