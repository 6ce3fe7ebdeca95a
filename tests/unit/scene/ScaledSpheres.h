// Unit spheres under transformations that scale unevenly, by nodes and by joints, and the normals of the
// ellipsoids that they become.
#pragma once

#include "engine/scene/Model.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <array>

namespace shoal::scene {

struct ScaledSphere {
    const char* name;
    void (*transform)(Model&); // changes a model of one node with one primitive, a unit sphere
    glm::mat3 modelFromSphere;
};

inline const glm::vec3 kUneven(0.5f, 1, 1.4f), kOther(1.2f, 0.7f, 0.4f);
inline const glm::quat kTurn = glm::angleAxis(0.8f, glm::normalize(glm::vec3(1, 2, 3)));

inline glm::mat3 scaling(const glm::vec3& s) {
    return {glm::vec3(s.x, 0, 0), glm::vec3(0, s.y, 0), glm::vec3(0, 0, s.z)};
}

// Skins every vertex to these joints with equal weights.
inline void bindTo(Model& model, const std::vector<Transform>& joints, const glm::mat4& jointFromMesh) {
    Skin& skin = model.skins.emplace_back();
    Primitive& primitive = model.meshes[0].primitives[0];
    glm::u16vec4 indices(0);
    glm::vec4 weights(0);
    for (const Transform& joint : joints) {
        const auto k = static_cast<int>(skin.joints.size());
        indices[k] = static_cast<uint16_t>(k);
        weights[k] = 1 / static_cast<float>(joints.size());
        skin.joints.push_back(static_cast<int>(model.nodes.size()));
        skin.jointFromMesh.push_back(jointFromMesh);
        model.order.push_back(static_cast<int>(model.nodes.size()));
        model.nodes.push_back({.parentFromNode = joint});
    }
    model.nodes[0].skin = 0;
    primitive.joints.assign(primitive.positions.size(), indices);
    primitive.weights.assign(primitive.positions.size(), weights);
}

inline const std::array kScaledSpheres = {
    ScaledSphere{"Node", [](Model& model) { model.nodes[0].parentFromNode.scale = kUneven; },
                 scaling(kUneven)},
    ScaledSphere{"MirroredNode",
                 [](Model& model) {
                     model.nodes[0].parentFromNode.scale = {-0.5f, 1, 1.4f};
                 },
                 scaling({-0.5f, 1, 1.4f})},
    // A turned and scaled child of a scaled parent: a shear.
    ScaledSphere{"NodeBelowAnother",
                 [](Model& model) {
                     model.nodes.push_back({.parentFromNode = {.scale = kUneven}, .children = {0}});
                     model.nodes[0].parent = 1;
                     model.nodes[0].parentFromNode = {.rotation = kTurn, .scale = kOther};
                     model.order = {1, 0};
                 },
                 scaling(kUneven) * glm::mat3_cast(kTurn) * scaling(kOther)},
    ScaledSphere{"Joint",
                 [](Model& model) { bindTo(model, {{.rotation = kTurn, .scale = kUneven}}, glm::mat4(1)); },
                 glm::mat3_cast(kTurn) * scaling(kUneven)},
    ScaledSphere{"InverseBindMatrix",
                 [](Model& model) { bindTo(model, {{.rotation = kTurn}}, glm::mat4(scaling(kUneven))); },
                 glm::mat3_cast(kTurn) * scaling(kUneven)},
    ScaledSphere{"TwoJoints",
                 [](Model& model) {
                     bindTo(model, {{.rotation = kTurn, .scale = kUneven}, {.scale = kOther}}, glm::mat4(1));
                 },
                 0.5f * (glm::mat3_cast(kTurn) * scaling(kUneven)) + 0.5f * scaling(kOther)},
};

// Returns the outward normal at a point of the ellipsoid: the gradient of |sphereFromModel x|^2.
inline glm::vec3 ellipsoidNormal(const glm::mat3& modelFromSphere, const glm::vec3& point) {
    const glm::mat3 sphereFromModel = glm::inverse(modelFromSphere);
    return glm::normalize(glm::transpose(sphereFromModel) * (sphereFromModel * point));
}

} // namespace shoal::scene
