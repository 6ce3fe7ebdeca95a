// Levels of detail of a mesh: a triangle smaller than a few pixels costs as much as a large one.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <vector>

namespace shoal::scene {

struct Lod {
    std::vector<uint32_t> vertices; // which of the primitive's; the rest is not needed
    std::vector<uint32_t> indices;  // triangles, into `vertices`
    float error = 0;                // how far the surface moves at most, about, in the primitive's units
};

// Makes levels of about half the triangles of the one before, finest first, by quadric edge collapse
// (meshoptimizer). Makes none of meshes that cannot be reduced and of primitives with morph targets.
std::vector<Lod> makeLods(const Primitive& primitive);

} // namespace shoal::scene
