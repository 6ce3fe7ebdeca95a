// Traces how much of its surroundings a body hides from its own surface in one pose: in mouths and gills,
// beneath fins, between fingers. For each vertex, by several threads; a fraction of a second a model.
#pragma once

#include "engine/occlusion/EllipsoidOcclusion.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

// Views only; one frame. indices: three a triangle. Positions in none of them have no self-occlusion.
struct SelfOccludingMesh {
    std::span<const glm::vec3> positions, normals; // normals: unit, one a position
    std::span<const uint32_t> indices;             // of what lets no light through
};

// Rays are cast from each corner and from three points in each triangle, and the vertices get the values
// whose interpolation comes nearest to what the rays found. Corners alone would not do: at the roots of fins
// they lie inside the body, and would darken all around. Kavan et al. 2011, "Least Squares Vertex Baking".
// rays: from each of these points. own: the body's own ellipsoids, to which the result is added. Returns the
// self-occlusion as EllipsoidOcclusion.h has it, one value a position, in the mesh's frame.
std::vector<glm::vec4> traceSelfOcclusion(const SelfOccludingMesh& body, std::span<const Occluder> own,
                                          int rays);

} // namespace shoal::occlusion
