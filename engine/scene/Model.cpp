#include "engine/scene/Model.h"

#include <algorithm>
#include <cassert>

namespace shoal::scene {

namespace {

template <class List> int findNamed(const List& list, const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

// T * R * S, glTF 2.0 specification 3.5.3.
glm::mat4 matrixOf(const Transform& t) {
    glm::mat4 matrix = glm::mat4_cast(t.rotation);
    for (int i = 0; i < 3; ++i) matrix[i] *= t.scale[i];
    matrix[3] = glm::vec4(t.translation, 1);
    return matrix;
}

} // namespace

int Model::findAnimation(const std::string& name) const { return findNamed(animations, name); }
int Model::findNode(const std::string& name) const { return findNamed(nodes, name); }

const Material& Model::materialOf(const Primitive& primitive) const {
    static const Material kDefault;
    return primitive.material < 0 ? kDefault : materials[static_cast<size_t>(primitive.material)];
}

const ImageRgba8* Model::imageOf(const TextureUse& use) const {
    const int image = use.texture < 0 ? -1 : textures[static_cast<size_t>(use.texture)].image;
    return image < 0 ? nullptr : &images[static_cast<size_t>(image)];
}

void restPose(const Model& model, Pose& pose) {
    const size_t count = model.nodes.size();
    pose.local.resize(count);
    pose.modelFromNode.resize(count, glm::mat4(1));
    pose.morphWeights.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const Node& node = model.nodes[i];
        pose.local[i] = node.parentFromNode;
        const std::vector<float>* weights = &node.morphWeights;
        if (weights->empty() && node.mesh >= 0)
            weights = &model.meshes[static_cast<size_t>(node.mesh)].morphWeights;
        pose.morphWeights[i] = *weights;
    }
    updateGlobals(model, pose);
}

void updateGlobals(const Model& model, Pose& pose) {
    assert(pose.local.size() == model.nodes.size());
    for (const int index : model.order) {
        const auto i = static_cast<size_t>(index);
        const Node& node = model.nodes[i];
        const glm::mat4 parentFromNode = node.matrix ? *node.matrix : matrixOf(pose.local[i]);
        pose.modelFromNode[i] = node.parent < 0
                                    ? parentFromNode
                                    : pose.modelFromNode[static_cast<size_t>(node.parent)] * parentFromNode;
    }
}

void skinMatrices(const Model& model, int skin, const Pose& pose, std::vector<glm::mat4>& out) {
    const Skin& from = model.skins[static_cast<size_t>(skin)];
    out.resize(from.joints.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = pose.modelFromNode[static_cast<size_t>(from.joints[i])] * from.jointFromMesh[i];
}

glm::mat4 skinMatrix(const Primitive& primitive, size_t vertex, std::span<const glm::mat4> joints) {
    glm::mat4 sum(0);
    for (int k = 0; k < 4; ++k) sum += primitive.weights[vertex][k] * joints[primitive.joints[vertex][k]];
    return sum;
}

MorphedVertex morphed(const Primitive& primitive, size_t vertex, std::span<const float> weights) {
    MorphedVertex moved{primitive.positions[vertex], primitive.normals[vertex]};
    for (size_t t = 0; t < primitive.morphTargets.size() && t < weights.size(); ++t) {
        const MorphTarget& target = primitive.morphTargets[t];
        if (!target.positions.empty()) moved.position += weights[t] * target.positions[vertex];
        if (!target.normals.empty()) moved.normal += weights[t] * target.normals[vertex];
    }
    return moved;
}

} // namespace shoal::scene
