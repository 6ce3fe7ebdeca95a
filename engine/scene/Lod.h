// Levels of detail of a mesh. A triangle smaller than a few pixels costs as much as a large one, so that
// distant models would otherwise cost most.
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

// Finest first, each of about half the triangles of the one before; empty for what cannot be reduced, and for
// primitives with morph targets. Quadric edge collapse (meshoptimizer).
std::vector<Lod> makeLods(const Primitive& primitive);

} // namespace shoal::scene
