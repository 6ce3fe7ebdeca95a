// The skin of a posed model as one body: for those who ask where it is and not how it looks.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <vector>

namespace shoal::scene {

struct Surface {
    std::vector<glm::vec3> positions, normals; // model frame; normals unit
    std::vector<uint32_t> indices;             // three a triangle
    std::vector<uint16_t> nodesOf; // the node that moves each position most: a joint, or the mesh's own
};

// Every primitive of every node, in the order of model.order. The pose's globals must be up to date.
Surface posedSurface(const Model& model, const Pose& pose);

// Mean reflectance over the texels of all materials in use, weighed by the area of their triangles in the mesh;
// surface; linear.
glm::vec3 meanBaseColour(const Model& model);

} // namespace shoal::scene
