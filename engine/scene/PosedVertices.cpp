#include "engine/scene/PosedVertices.h"

#include <glm/common.hpp>

#include <limits>
#include <span>

namespace shoal::scene {

namespace {

glm::vec3 morphedPosition(const Primitive& primitive, size_t vertex, std::span<const float> weights) {
    glm::vec3 position = primitive.positions[vertex];
    for (size_t t = 0; t < primitive.morphTargets.size() && t < weights.size(); ++t)
        if (const auto& deltas = primitive.morphTargets[t].positions; !deltas.empty() && weights[t] != 0)
            position += weights[t] * deltas[vertex];
    return position;
}

// Sum over joints of weight * modelFromNode * jointFromMesh, joint by joint, so that no matrices need
// keeping.
glm::vec3 skinnedPosition(const Primitive& primitive, size_t vertex, const Skin& skin, const Pose& pose,
                          const glm::vec3& pMesh) {
    glm::vec4 sum(0);
    for (int k = 0; k < 4; ++k) {
        const float weight = primitive.weights[vertex][k];
        if (weight == 0) continue;
        const size_t joint = primitive.joints[vertex][k];
        const glm::mat4& modelFromJoint = pose.modelFromNode[static_cast<size_t>(skin.joints[joint])];
        sum += weight * (modelFromJoint * (skin.jointFromMesh[joint] * glm::vec4(pMesh, 1)));
    }
    return glm::vec3(sum);
}

} // namespace

glm::vec3 posedPosition(const Model& model, const Pose& pose, int index, const Primitive& primitive,
                        size_t vertex) {
    const auto n = static_cast<size_t>(index);
    const Node& node = model.nodes[n];
    const glm::vec3 pMesh = morphedPosition(primitive, vertex, pose.morphWeights[n]);
    if (node.skin >= 0 && !primitive.joints.empty())
        return skinnedPosition(primitive, vertex, model.skins[static_cast<size_t>(node.skin)], pose, pMesh);
    return glm::vec3(pose.modelFromNode[n] * glm::vec4(pMesh, 1));
}

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
