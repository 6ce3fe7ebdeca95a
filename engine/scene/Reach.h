// How far a body reaches however its joints turn.
#pragma once

#include "engine/scene/Model.h"

#include <vector>

namespace shoal::scene {

// What a node moves most lies in the ball, in the node's frame. Of skin between two joints that is as good as
// all of it: it lies between where each would take it.
struct NodeReach {
    int node = 0;
    glm::vec3 centre{0};
    float radius = 0;
};

// Of the nodes that move anything. The pose's globals must be up to date; the model's meshes must still be
// there.
std::vector<NodeReach> reachOf(const Model& model, const Pose& rest);

// Around all of it in another pose, world frame. worldFromModel may scale, alike in all directions.
Ball ballAround(const std::vector<NodeReach>& reach, const Pose& pose, const glm::mat4& worldFromModel);

} // namespace shoal::scene
