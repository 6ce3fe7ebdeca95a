// Triangle mesh of one body.
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

// Returns the closed surface at which a smooth function is 0, negative inside. Each vertex is moved onto the
// surface, and normals are the function's gradient. Naive surface nets (Gibson 1998, "Constrained Elastic
// Surface Nets") on cubes of `cell` metres.
Mesh surfaceOf(const std::function<float(const glm::vec3&)>& distance, const glm::vec3& low,
               const glm::vec3& high, float cell);

} // namespace shoal::bench
