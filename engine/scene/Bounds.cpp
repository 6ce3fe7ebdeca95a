#include "engine/scene/PosedVertices.h"

#include <glm/common.hpp>

#include <limits>

namespace shoal::scene {

Bounds posedBounds(const Model& model, const Pose& pose) {
    constexpr float kFar = std::numeric_limits<float>::max();
    Bounds bounds{glm::vec3(kFar), glm::vec3(-kFar)};
    bool any = false;
    for (const int index : model.order) {
        const Node& node = model.nodes[static_cast<size_t>(index)];
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            for (size_t v = 0; v < primitive.positions.size(); ++v) {
                const glm::vec3 pModel = posedPosition(model, pose, index, primitive, v);
                bounds.low = glm::min(bounds.low, pModel);
                bounds.high = glm::max(bounds.high, pModel);
                any = true;
            }
        }
    }
    return any ? bounds : Bounds{};
}

} // namespace shoal::scene
