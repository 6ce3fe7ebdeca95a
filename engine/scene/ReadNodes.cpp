#include "engine/scene/ReadNodes.h"

#include "engine/scene/Accessors.h"
#include "engine/scene/Document.h"
#include "engine/scene/Loading.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::scene {

namespace {

bool isAffine(const glm::mat4& m) {
    // Exporters write exact zeros and ones; the slack is for files that went through 16-bit numbers.
    constexpr float kSlack = 1e-3f;
    return std::abs(m[0][3]) <= kSlack && std::abs(m[1][3]) <= kSlack && std::abs(m[2][3]) <= kSlack &&
           std::abs(m[3][3] - 1) <= kSlack;
}

void makeAffine(glm::mat4& m) { m[0][3] = m[1][3] = m[2][3] = 0, m[3][3] = 1; }

glm::vec3 vector3(const std::vector<double>& numbers, glm::vec3 otherwise) {
    if (numbers.empty()) return otherwise;
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

glm::quat rotationOf(const std::vector<double>& r, const std::string& who) {
    if (r.empty()) return {1, 0, 0, 0};
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 1e-6)) fault(who, ".rotation is no quaternion of length 1");
    return {static_cast<float>(r[3] / length), static_cast<float>(r[0] / length),
            static_cast<float>(r[1] / length), static_cast<float>(r[2] / length)};
}

Node readNode(Loading& loading, const tinygltf::Node& from, const std::string& who) {
    Node node;
    node.name = from.name;
    node.children = from.children;
    node.mesh = from.mesh;
    node.skin = from.skin;
    for (const double weight : from.weights) node.morphWeights.push_back(static_cast<float>(weight));
    if (!from.matrix.empty()) {
        glm::mat4 matrix;
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = static_cast<float>(from.matrix[static_cast<size_t>(i)]);
        if (!isAffine(matrix)) fault(who, ".matrix is no transform: its last row is not 0 0 0 1");
        makeAffine(matrix);
        if (const auto transform = split(matrix))
            node.parentFromNode = *transform;
        else
            node.matrix = matrix;
    } else {
        node.parentFromNode = {vector3(from.translation, glm::vec3(0)), rotationOf(from.rotation, who),
                               vector3(from.scale, glm::vec3(1))};
    }
    if (node.skin >= 0 && node.mesh < 0) {
        loading.warn(who, " has a skin, but no mesh");
        node.skin = -1;
    }
    return node;
}

void joinParents(Model& model) {
    for (size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children) {
            Node& node = model.nodes[static_cast<size_t>(child)];
            if (node.parent >= 0)
                fault(element("nodes", child), " is a child twice, of ", element("nodes", node.parent),
                      " and ", element("nodes", static_cast<int64_t>(i)));
            node.parent = static_cast<int>(i);
        }

    // With one parent each, what no root reaches is a cycle.
    std::vector<int> reached;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (model.nodes[i].parent < 0) reached.push_back(static_cast<int>(i));
    for (size_t i = 0; i < reached.size(); ++i)
        for (const int child : model.nodes[static_cast<size_t>(reached[i])].children)
            reached.push_back(child);
    if (reached.size() == model.nodes.size()) return;
    std::vector<bool> isReached(model.nodes.size(), false);
    for (const int node : reached) isReached[static_cast<size_t>(node)] = true;
    const auto lost = std::find(isReached.begin(), isReached.end(), false) - isReached.begin();
    fault(element("nodes", lost), " is its own ancestor, or below one that is");
}

void fillOrder(const tinygltf::Model& gltf, Model& model) {
    if (gltf.scenes.empty()) {
        for (size_t i = 0; i < model.nodes.size(); ++i)
            if (model.nodes[i].parent < 0) model.order.push_back(static_cast<int>(i));
    } else {
        const int scene = std::max(gltf.defaultScene, 0);
        std::vector<bool> taken(model.nodes.size(), false);
        for (const int root : gltf.scenes[static_cast<size_t>(scene)].nodes) {
            if (model.nodes[static_cast<size_t>(root)].parent >= 0)
                fault(element("scenes", scene), ".nodes holds ", element("nodes", root),
                      ", which has a parent");
            if (taken[static_cast<size_t>(root)])
                fault(element("scenes", scene), ".nodes holds ", element("nodes", root), " twice");
            taken[static_cast<size_t>(root)] = true;
            model.order.push_back(root);
        }
    }
    for (size_t i = 0; i < model.order.size(); ++i)
        for (const int child : model.nodes[static_cast<size_t>(model.order[i])].children)
            model.order.push_back(child);
}

Skin readSkin(const Loading& loading, const tinygltf::Model& gltf, const tinygltf::Skin& from,
              const std::string& who) {
    Skin skin;
    skin.joints = from.joints;
    const size_t count = skin.joints.size();
    if (count == 0) fault(who, ".joints is empty");
    if (count > loading.limits.maxJoints)
        fault(who, " has ", count, " joints, more than the limit of ", loading.limits.maxJoints);
    std::vector<int> sorted = skin.joints;
    std::sort(sorted.begin(), sorted.end());
    if (const auto twin = std::adjacent_find(sorted.begin(), sorted.end()); twin != sorted.end())
        fault(who, ".joints holds ", element("nodes", *twin), " twice");
    skin.jointFromMesh.assign(count, glm::mat4(1));
    if (from.inverseBindMatrices < 0) return skin;

    const std::string matrices = element("accessors", from.inverseBindMatrices);
    const tinygltf::Accessor& accessor = gltf.accessors[static_cast<size_t>(from.inverseBindMatrices)];
    if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fault(who, ".inverseBindMatrices: ", matrices, " does not hold matrices of floats");
    if (accessor.count < count)
        fault(who, " has ", count, " joints, but ", matrices, " only ", accessor.count, " matrices");
    if (accessor.count > loading.limits.maxJoints)
        fault(matrices, " has ", accessor.count, " inverse bind matrices, more than the limit of ",
              loading.limits.maxJoints);
    const std::vector<float> numbers = readFloats(gltf, from.inverseBindMatrices);
    for (size_t i = 0; i < count; ++i) {
        glm::mat4& matrix = skin.jointFromMesh[i];
        matrix = glm::make_mat4(numbers.data() + 16 * i);
        if (!isAffine(matrix))
            fault(matrices, ": inverse bind matrix ", i, " does not end in the row 0 0 0 1");
        makeAffine(matrix);
    }
    return skin;
}

void checkJointsInScene(const Model& model) {
    std::vector<bool> inScene(model.nodes.size(), false);
    for (const int node : model.order) inScene[static_cast<size_t>(node)] = true;
    std::vector<bool> checked(model.skins.size(), false);
    for (const int index : model.order) {
        const int skin = model.nodes[static_cast<size_t>(index)].skin;
        if (skin < 0 || checked[static_cast<size_t>(skin)]) continue;
        checked[static_cast<size_t>(skin)] = true;
        for (const int joint : model.skins[static_cast<size_t>(skin)].joints)
            if (!inScene[static_cast<size_t>(joint)])
                fault(element("nodes", index), " uses ", element("skins", skin), ", whose joint ",
                      element("nodes", joint), " is not in the scene");
    }
}

} // namespace

std::optional<Transform> split(const glm::mat4& parentFromNode) {
    Transform t;
    t.translation = glm::vec3(parentFromNode[3]);
    glm::mat3 axes(parentFromNode);
    for (int i = 0; i < 3; ++i) {
        t.scale[i] = glm::length(axes[i]);
        if (!std::isnormal(t.scale[i])) return std::nullopt; // flattened, or too long or short for floats
        axes[i] /= t.scale[i];
    }
    // Matrices printed with six digits are orthogonal to about 1e-6 an element; sheared ones are off by more.
    constexpr float kSlack = 1e-4f;
    if (std::abs(glm::dot(axes[0], axes[1])) > kSlack || std::abs(glm::dot(axes[1], axes[2])) > kSlack ||
        std::abs(glm::dot(axes[2], axes[0])) > kSlack)
        return std::nullopt;
    if (glm::determinant(axes) < 0) { // a mirror: any axis will do
        t.scale.x = -t.scale.x;
        axes[0] = -axes[0];
    }
    t.rotation = glm::normalize(glm::quat_cast(axes));
    return t;
}

void readNodes(Loading& loading, const Document& document, Model& model) {
    const tinygltf::Model& gltf = document.gltf;
    for (const tinygltf::Node& node : gltf.nodes)
        model.nodes.push_back(
            readNode(loading, node, element("nodes", static_cast<int64_t>(model.nodes.size()))));
    joinParents(model);
    fillOrder(gltf, model);
    for (const tinygltf::Skin& skin : gltf.skins)
        model.skins.push_back(
            readSkin(loading, gltf, skin, element("skins", static_cast<int64_t>(model.skins.size()))));
    checkJointsInScene(model);
}

} // namespace shoal::scene
