// A body's triangles.
#pragma once

#include "engine/math/Sphere.h"

#include <glm/glm.hpp>

#include <span>

namespace shoal::occlusion {

// One frame, metres; unit normals, one for each position; all finite. Views: the owner keeps them alive.
struct BodyMesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::uvec3> triangles;
};

// Returns whether every edge is shared by two triangles that run along it in opposite directions, once
// vertices at the same place are merged. Such a body has an inside: rays hit it only where they enter.
bool isClosed(const BodyMesh& mesh);

// Returns a sphere around the middle of the bounding box; without triangles its radius is 0.
Sphere boundingSphere(const BodyMesh& mesh);

} // namespace shoal::occlusion
