// The game's animals as bodies.
#pragma once

#include "Bodies.h"
#include "engine/core/Files.h"
#include "engine/scene/Model.h"

#include <gtest/gtest.h>

namespace shoal::occlusion {

inline scene::Model loadAnimal(const std::string& name) {
    auto model = scene::loadModel(dataRoot() / "content" / "models" / (name + ".glb"));
    EXPECT_TRUE(model.ok()) << (model ? "" : model.error().message());
    return model ? std::move(*model) : scene::Model{};
}

// Returns the model's opaque parts in this pose, model frame.
inline Body bodyOf(const scene::Model& model, const scene::Pose& pose) {
    Body body;
    std::vector<glm::mat4> skin;
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        const scene::Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) scene::skinMatrices(model, node.skin, pose, skin);
        for (const scene::Primitive& part : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            if (part.material >= 0 &&
                model.materials[static_cast<size_t>(part.material)].alphaMode == scene::AlphaMode::Blend)
                continue;
            const auto first = static_cast<uint32_t>(body.positions.size());
            for (size_t v = 0; v < part.positions.size(); ++v) {
                const bool skinned = node.skin >= 0 && !part.weights.empty();
                const glm::mat4 place = skinned ? scene::skinMatrix(part, v, skin) : pose.modelFromNode[n];
                body.positions.emplace_back(place * glm::vec4(part.positions[v], 1));
                body.normals.push_back(glm::normalize(glm::mat3(place) * part.normals[v]));
            }
            for (size_t i = 0; i + 2 < part.indices.size(); i += 3)
                body.triangles.emplace_back(first + part.indices[i], first + part.indices[i + 1],
                                            first + part.indices[i + 2]);
        }
    }
    return body;
}

inline Body animal(const std::string& name) {
    const scene::Model model = loadAnimal(name);
    scene::Pose pose;
    scene::restPose(model, pose);
    return bodyOf(model, pose);
}

} // namespace shoal::occlusion
