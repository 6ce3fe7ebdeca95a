// Makes levels of detail, because a triangle smaller than a few pixels costs as much as a large one.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <vector>

namespace shoal::scene {

struct Lod {
    std::vector<uint32_t> vertices; // indices of the primitive's vertices that it uses
    std::vector<uint32_t> indices;  // triangles, into `vertices`
    float error = 0;                // approximate greatest displacement of the surface, primitive's units
};

// Makes levels of about half the triangles of the one before, finest first, by quadric edge collapse
// (meshoptimizer). Makes none of meshes that cannot be reduced and of primitives with morph targets.
std::vector<Lod> makeLods(const Primitive& primitive);

} // namespace shoal::scene
