// A body's triangles, and checks of them that are made before memory is taken.
#pragma once

#include "engine/core/Result.h"
#include "engine/math/Sphere.h"

#include <glm/glm.hpp>

#include <span>

namespace shoal::occlusion {

// One frame, metres; normals of unit length, one for each position. Views: the owner keeps them alive.
struct BodyMesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::uvec3> triangles;
};

// Errors: positions or normals that are not finite, as many normals as positions missing, indices beyond
// them, more than 2^24 triangles.
Status checkMesh(const BodyMesh& mesh);

// Every edge is shared by two triangles that run along it in opposite senses, once vertices at the same place
// are taken for one. Such a body has an inside: rays meet it only where they enter.
bool isClosed(const BodyMesh& mesh);

// Around the middle of the bounding box; of no triangle, radius 0.
Sphere boundingSphere(const BodyMesh& mesh);

} // namespace shoal::occlusion
