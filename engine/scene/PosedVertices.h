// Positions of a posed model's vertices.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

// In the model frame, skinned and morphed: vertex `vertex` of a primitive of node `node`'s mesh.
glm::vec3 posedPosition(const Model& model, const Pose& pose, int node, const Primitive& primitive,
                        size_t vertex);

} // namespace shoal::scene
