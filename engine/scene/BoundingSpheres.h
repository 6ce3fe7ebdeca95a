// How far a body reaches however its joints turn.
#pragma once

#include "engine/scene/Model.h"

#include <span>
#include <vector>

namespace shoal::scene {

// Some of what a node moves most, in the node's frame; all of it lies in the node's spheres, and skin between
// two joints, which lies between where each would take it, in theirs.
struct NodeSphere {
    int node = 0;
    glm::vec3 centre{0};
    float radius = 0;
};

// One sphere or more for each node that moves anything. The pose's globals must be up to date; the model's
// meshes must still be there.
std::vector<NodeSphere> boundingSpheresOf(const Model& model, const Pose& rest);

// Of another pose, world frame: one sphere for each. worldFromModel may scale, alike in all directions.
void placeSpheres(const std::vector<NodeSphere>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                  std::vector<Sphere>& spheres);

Sphere boundingSphereOf(std::span<const Sphere> spheres); // holds them all

} // namespace shoal::scene
