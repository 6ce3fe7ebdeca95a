#include "engine/scene/Gltf.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace shoal::scene {

namespace {

// Makes the last row 0 0 0 1; false where it is far from that. Exporters write exact zeros and ones; the
// slack is for files that went through 16-bit numbers.
bool makeAffine(glm::mat4& m) {
    constexpr float kSlack = 1e-3f;
    for (int column = 0; column < 4; ++column) {
        const float exact = column == 3 ? 1.0f : 0.0f;
        if (!(std::abs(m[column][3] - exact) <= kSlack)) return false;
        m[column][3] = exact;
    }
    return true;
}

// Returns the transform that gives this affine matrix, if there is one (no shear, no flattened axis).
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
    for (int i = 0; i < 3; ++i)
        if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kSlack) return std::nullopt;
    if (glm::determinant(axes) < 0) { // a mirror: any axis will do
        t.scale.x = -t.scale.x;
        axes[0] = -axes[0];
    }
    t.rotation = glm::normalize(glm::quat_cast(axes));
    return t;
}

template <int kCount>
glm::vec<kCount, double> vectorOf(const Json& from, const char* name, std::vector<double> otherwise) {
    glm::vec<kCount, double> read;
    const auto numbers = from.value(name, std::move(otherwise));
    for (int i = 0; i < kCount; ++i) read[i] = numbers[static_cast<size_t>(i)];
    return read;
}

Transform readTransform(const Json& from, const std::string& who) {
    Transform t;
    t.translation = vectorOf<3>(from, "translation", {0, 0, 0});
    t.scale = vectorOf<3>(from, "scale", {1, 1, 1});
    const glm::dvec4 r = vectorOf<4>(from, "rotation", {0, 0, 0, 1});
    const double length = glm::length(r);
    if (!(length > 1e-6)) fault(who, ".rotation is no quaternion of length 1");
    const glm::vec4 unit(r / length);
    t.rotation = {unit.w, unit.x, unit.y, unit.z};
    return t;
}

Node readNode(GltfFile& file, const Json& from, const std::string& who) {
    Node node;
    node.name = from.value("name", "");
    node.children = from.value("children", node.children);
    node.mesh = from.value("mesh", -1);
    node.skin = from.value("skin", -1);
    node.morphWeights = from.value("weights", node.morphWeights);
    if (!from.contains("matrix")) {
        node.parentFromNode = readTransform(from, who);
    } else {
        glm::mat4 matrix = glm::make_mat4(from["matrix"].get<std::vector<float>>().data());
        if (!makeAffine(matrix)) fault(who, ".matrix is no transform: its last row is not 0 0 0 1");
        if (const auto transform = split(matrix))
            node.parentFromNode = *transform;
        else
            node.matrix = matrix;
    }
    if (node.skin >= 0 && node.mesh < 0) {
        file.warn(who, " has a skin, but no mesh");
        node.skin = -1;
    }
    return node;
}

// Returns these nodes and all below them, parents first. Only for nodes that form trees.
std::vector<int> withDescendants(const Model& model, std::vector<int> nodes) {
    for (size_t i = 0; i < nodes.size(); ++i)
        for (const int child : model.nodes[nodes[i]].children) nodes.push_back(child);
    return nodes;
}

// Returns the nodes without a parent.
std::vector<int> joinParents(Model& model) {
    const auto count = static_cast<int>(model.nodes.size());
    for (int i = 0; i < count; ++i)
        for (const int child : model.nodes[i].children) {
            int& parent = model.nodes[child].parent;
            if (parent >= 0)
                fault(element("nodes", child), " is a child twice, of ", element("nodes", parent), " and ",
                      element("nodes", i));
            parent = i;
        }
    std::vector<int> roots;
    for (int i = 0; i < count; ++i)
        if (model.nodes[i].parent < 0) roots.push_back(i);
    // Each has one parent, so a node that no root reaches is in a cycle or below one.
    const std::vector<int> all = withDescendants(model, roots);
    const std::set<int> reached(all.begin(), all.end());
    for (int i = 0; i < count; ++i)
        if (!reached.contains(i)) fault(element("nodes", i), " is its own ancestor, or below one that is");
    return roots;
}

// Returns the roots of the default scene.
std::vector<int> sceneRoots(const Json& root, const Model& model) {
    const size_t scene = root.value("scene", size_t{0});
    const auto nodes = root["scenes"][scene].value("nodes", std::vector<int>());
    std::set<int> taken;
    for (const int node : nodes) {
        const std::string who = element("scenes", scene) + ".nodes holds " + element("nodes", node);
        if (model.nodes[node].parent >= 0) fault(who, ", which has a parent");
        if (!taken.insert(node).second) fault(who, " twice");
    }
    return nodes;
}

Skin readSkin(const GltfFile& file, const Json& from, const std::string& who) {
    Skin skin;
    skin.joints = from["joints"].get<std::vector<int>>();
    const size_t count = skin.joints.size(), limit = file.limits.maxJoints;
    if (count == 0) fault(who, ".joints is empty");
    if (count > limit) fault(who, " has ", count, " joints, more than the limit of ", limit);
    std::set<int> seen;
    for (const int joint : skin.joints)
        if (!seen.insert(joint).second) fault(who, ".joints holds ", element("nodes", joint), " twice");
    skin.jointFromMesh.assign(count, glm::mat4(1));
    if (!from.contains("inverseBindMatrices")) return skin;

    const size_t index = from["inverseBindMatrices"];
    const std::string matrices = element("accessors", index);
    const Accessor& accessor = file.accessors[index];
    if (accessor.type != "MAT4" || accessor.componentType != kFloat)
        fault(who, ".inverseBindMatrices: ", matrices, " does not hold matrices of floats");
    if (accessor.count < count)
        fault(who, " has ", count, " joints, but ", matrices, " only ", accessor.count, " matrices");
    if (accessor.count > limit)
        fault(matrices, " has ", accessor.count, " inverse bind matrices, more than the limit of ", limit);
    const std::vector<float> numbers = readFloats(file, index);
    for (size_t i = 0; i < count; ++i) {
        skin.jointFromMesh[i] = glm::make_mat4(numbers.data() + 16 * i);
        if (!makeAffine(skin.jointFromMesh[i]))
            fault(matrices, ": inverse bind matrix ", i, " does not end in the row 0 0 0 1");
    }
    return skin;
}

void checkJointsInScene(const Model& model) {
    const std::set<int> inScene(model.order.begin(), model.order.end());
    std::set<int> checked;
    for (const int index : model.order) {
        const int skin = model.nodes[index].skin;
        if (skin < 0 || !checked.insert(skin).second) continue;
        for (const int joint : model.skins[skin].joints)
            if (!inScene.contains(joint))
                fault(element("nodes", index), " uses ", element("skins", skin), ", whose joint ",
                      element("nodes", joint), " is not in the scene");
    }
}

} // namespace

void readNodes(GltfFile& file, Model& model) {
    for (const Json& node : member(file.root, "nodes"))
        model.nodes.push_back(readNode(file, node, element("nodes", model.nodes.size())));
    const std::vector<int> roots = joinParents(model);
    const bool anyScene = !member(file.root, "scenes").empty();
    model.order = withDescendants(model, anyScene ? sceneRoots(file.root, model) : roots);
    for (const Json& skin : member(file.root, "skins"))
        model.skins.push_back(readSkin(file, skin, element("skins", model.skins.size())));
    checkJointsInScene(model);
}

} // namespace shoal::scene
