// Asserts what engine/scene/Model.h promises of every model that it returns.
#pragma once

#include "engine/scene/Model.h"
#include "tests/Test.h"

namespace shoal::scene {

inline void expectSound(const Model& model) {
    const auto nodes = static_cast<int>(model.nodes.size());
    for (const int node : model.order) ASSERT_TRUE(node >= 0 && node < nodes);
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            const size_t vertices = primitive.positions.size();
            ASSERT_EQ(primitive.indices.size() % 3, 0u);
            for (const uint32_t index : primitive.indices) ASSERT_LT(index, vertices);
            ASSERT_EQ(primitive.normals.size(), vertices);
            for (size_t v = 0; v < vertices; ++v)
                for (int k = 0; k < 3; ++k)
                    ASSERT_TRUE(std::isfinite(primitive.positions[v][k]) &&
                                std::isfinite(primitive.normals[v][k]));
            for (const size_t size :
                 {primitive.tangents.size(), primitive.texCoords[0].size(), primitive.texCoords[1].size(),
                  primitive.coloursLin.size(), primitive.joints.size(), primitive.weights.size()})
                ASSERT_TRUE(size == 0 || size == vertices);
            ASSERT_LT(primitive.material, static_cast<int>(model.materials.size()));
        }
    Pose pose;
    restPose(model, pose);
    std::vector<glm::mat4> matrices;
    for (size_t skin = 0; skin < model.skins.size(); ++skin)
        skinMatrices(model, static_cast<int>(skin), pose, matrices);
    for (size_t animation = 0; animation < model.animations.size(); ++animation)
        for (const float time_s : {-1.0f, 0.0f, 0.5f, 1e30f})
            animate(model, static_cast<int>(animation), time_s, pose, 0.5f);
    updateGlobals(model, pose);
    posedBounds(model, pose);
}

} // namespace shoal::scene
