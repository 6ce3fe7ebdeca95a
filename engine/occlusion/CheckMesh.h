// Whether a body's triangles can be seen at all; asked before memory is taken.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/Visibility.h"

namespace shoal::occlusion {

// Errors: positions or normals that are not finite, as many normals as positions missing, indices beyond
// them, more than 2^24 triangles.
Status checkMesh(const BodyMesh& mesh);

// Every edge is shared by two triangles that run along it in opposite senses, once vertices at the same place
// are taken for one. Such a body has an inside: rays meet it only where they enter.
bool isClosed(const BodyMesh& mesh);

// Around the middle of the bounding box; no triangle, no radius. Metres.
struct Ball {
    glm::vec3 centre{0};
    float radius = 0;
};
Ball boundingBall(const BodyMesh& mesh);

} // namespace shoal::occlusion
