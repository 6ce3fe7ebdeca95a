// Whether a model is what engine/scene/Model.h promises of every model that is loaded.
#pragma once

#include "engine/scene/Model.h"

#include <algorithm>
#include <cmath>

namespace shoal::scene {

inline bool isSound(const Primitive& primitive, const Model& model) {
    const size_t vertices = primitive.positions.size();
    const auto fits = [&](const auto& values) { return values.empty() || values.size() == vertices; };
    const auto finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return primitive.indices.size() % 3 == 0 &&
           std::ranges::all_of(primitive.indices, [&](uint32_t index) { return index < vertices; }) &&
           std::ranges::all_of(primitive.positions, finite) && primitive.normals.size() == vertices &&
           std::ranges::all_of(primitive.normals, finite) && fits(primitive.tangents) &&
           fits(primitive.texCoords[0]) && fits(primitive.texCoords[1]) && fits(primitive.coloursLin) &&
           fits(primitive.joints) && fits(primitive.weights) &&
           primitive.material < static_cast<int>(model.materials.size());
}

inline bool isSound(const Model& model) {
    for (const int node : model.order)
        if (node < 0 || node >= static_cast<int>(model.nodes.size())) return false;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives)
            if (!isSound(primitive, model)) return false;
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
    return true;
}

} // namespace shoal::scene
