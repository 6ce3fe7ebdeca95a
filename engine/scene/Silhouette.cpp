#include "engine/scene/Silhouette.h"

#include "engine/scene/PosedVertices.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::scene {

Silhouette silhouetteOf(const Model& model, const Pose& pose) {
    const Bounds bounds = posedBounds(model, pose);
    Silhouette silhouette{bounds.low.z, bounds.high.z, {}};
    const float slice = (silhouette.front - silhouette.back) / Silhouette::kSlices;
    if (!(slice > 0)) return silhouette;
    for (const int index : model.order) {
        const Node& node = model.nodes[static_cast<size_t>(index)];
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives)
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                std::array<glm::vec3, 3> p;
                for (size_t k = 0; k < 3; ++k)
                    p[k] = posedPosition(model, pose, index, primitive, primitive.indices[i + k]);
                const glm::vec3 area = 0.5f * glm::abs(glm::cross(p[1] - p[0], p[2] - p[0]));
                const float z = (p[0].z + p[1].z + p[2].z) / 3;
                const auto at = static_cast<size_t>(
                    std::clamp((z - silhouette.back) / slice, 0.0f, Silhouette::kSlices - 1.0f));
                silhouette.half[at] += glm::vec2(area.y, area.x) / (4 * slice); // both sides, half a width
            }
    }
    return silhouette;
}

} // namespace shoal::scene
