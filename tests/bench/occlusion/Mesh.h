// Triangle mesh of one body.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <vector>

namespace shoal::bench {

struct Mesh {
    std::vector<glm::vec3> positions, normals; // metres; unit length, one per position
    std::vector<glm::uvec3> triangles;

    occlusion::BodyMesh view() const { return {positions, normals, triangles}; }
};

// Three closed bodies made in code, about 20 cm across: like the teapot and the bunny of the literature, and
// a torus.
Mesh teapot(); // belly, lid, spout and handle in one
Mesh bunny();  // sitting, ears up
Mesh torus();  // lying: axis +Y

} // namespace shoal::bench
