// Triangles of one body, owned.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <functional>
#include <vector>

namespace shoal::bench {

struct Mesh {
    std::vector<glm::vec3> positions, normals; // metres; unit length, one per position
    std::vector<glm::uvec3> triangles;

    occlusion::BodyMesh view() const { return {positions, normals, triangles}; }
};

// Surface where a smooth function is 0, negative inside: closed, each vertex moved onto the surface, normals
// its gradient. Naive surface nets (Gibson 1998, "Constrained Elastic Surface Nets") on cubes of `cell`
// metres.
Mesh surfaceOf(const std::function<float(const glm::vec3&)>& distance, const glm::vec3& low,
               const glm::vec3& high, float cell);

} // namespace shoal::bench
