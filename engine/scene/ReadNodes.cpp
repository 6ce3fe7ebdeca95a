#include "engine/scene/Gltf.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace shoal::scene {

namespace {

// Sets the last row to 0 0 0 1; returns false if it is not nearly that. Exporters write exact zeros and ones;
// the tolerance is for files that went through 16-bit numbers.
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
        if (!std::isnormal(t.scale[i])) return std::nullopt; // 0, or out of the range of floats
        axes[i] /= t.scale[i];
    }
    // Matrices printed with six digits are orthogonal to about 1e-6 an element; sheared ones are off by more.
    constexpr float kSlack = 1e-4f;
    for (int i = 0; i < 3; ++i)
        if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kSlack) return std::nullopt;
    if (glm::determinant(axes) < 0) { // a reflection: any axis can be the negative one
        t.scale.x = -t.scale.x;
        axes[0] = -axes[0];
    }
    t.rotation = glm::normalize(glm::quat_cast(axes));
    return t;
}

Transform readTransform(const tinygltf::Node& from, const std::string& who) {
    Transform t;
    if (!from.translation.empty()) t.translation = glm::make_vec3(from.translation.data());
    if (!from.scale.empty()) t.scale = glm::make_vec3(from.scale.data());
    if (!from.rotation.empty()) {
        const glm::dvec4 r = glm::make_vec4(from.rotation.data());
        const double length = glm::length(r);
        if (!(length > 1e-6)) fault(who, ".rotation is no quaternion of length 1");
        const glm::vec4 unit(r / length);
        t.rotation = {unit.w, unit.x, unit.y, unit.z};
    }
    return t;
}

Node readNode(GltfFile& file, const tinygltf::Node& from, const std::string& who) {
    Node node{.name = from.name, .children = from.children, .mesh = from.mesh, .skin = from.skin};
    for (const double weight : from.weights) node.morphWeights.push_back(static_cast<float>(weight));
    size_t targets = 0;
    if (node.mesh >= 0 && !file.gltf.meshes[node.mesh].primitives.empty())
        targets = file.gltf.meshes[node.mesh].primitives[0].targets.size();
    if (!from.weights.empty() && from.weights.size() != targets)
        fault(who, " has ", from.weights.size(), " weights for ", targets, " morph targets");
    if (from.matrix.empty()) {
        node.parentFromNode = readTransform(from, who);
    } else {
        glm::mat4 matrix(glm::make_mat4(from.matrix.data()));
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

// Sets the parents of all nodes, and returns the nodes without one.
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
std::vector<int> sceneRoots(const tinygltf::Model& gltf, const Model& model) {
    const int scene = std::max(gltf.defaultScene, 0);
    std::set<int> taken;
    for (const int root : gltf.scenes[scene].nodes) {
        const std::string who = element("scenes", scene) + ".nodes holds " + element("nodes", root);
        if (model.nodes[root].parent >= 0) fault(who, ", which has a parent");
        if (!taken.insert(root).second) fault(who, " twice");
    }
    return gltf.scenes[scene].nodes;
}

Skin readSkin(const GltfFile& file, const tinygltf::Skin& from, const std::string& who) {
    Skin skin;
    skin.joints = from.joints;
    const size_t count = skin.joints.size(), limit = file.limits.maxJoints;
    if (count == 0) fault(who, ".joints is empty");
    if (count > limit) fault(who, " has ", count, " joints, more than the limit of ", limit);
    std::set<int> seen;
    for (const int joint : skin.joints)
        if (!seen.insert(joint).second) fault(who, ".joints holds ", element("nodes", joint), " twice");
    skin.jointFromMesh.assign(count, glm::mat4(1));
    if (from.inverseBindMatrices < 0) return skin;

    const std::string matrices = element("accessors", from.inverseBindMatrices);
    const tinygltf::Accessor& accessor = file.gltf.accessors[from.inverseBindMatrices];
    if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fault(who, ".inverseBindMatrices: ", matrices, " does not hold matrices of floats");
    if (accessor.count < count)
        fault(who, " has ", count, " joints, but ", matrices, " only ", accessor.count, " matrices");
    if (accessor.count > limit)
        fault(matrices, " has ", accessor.count, " inverse bind matrices, more than the limit of ", limit);
    const std::vector<float> numbers = readFloats(file.gltf, from.inverseBindMatrices);
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

using Interpolation = Channel::Interpolation;
using Target = Channel::Target;

struct TargetKind {
    Target target;
    int type;          // type of the accessor with its values
    bool mayBeInteger; // normalized
};
const std::map<std::string, TargetKind> kTargets = {
    {"translation", {Target::Translation, TINYGLTF_TYPE_VEC3, false}},
    {"rotation", {Target::Rotation, TINYGLTF_TYPE_VEC4, true}},
    {"scale", {Target::Scale, TINYGLTF_TYPE_VEC3, false}},
    {"weights", {Target::Weights, TINYGLTF_TYPE_SCALAR, true}}};

Interpolation interpolationOf(const std::string& name, const std::string& who) {
    if (name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    fault(who, ".interpolation is ", quoted(name), ", none of glTF");
}

std::vector<float> readTimes(GltfFile& file, int input, const std::string& who) {
    const std::string name = element("accessors", input);
    const tinygltf::Accessor& accessor = file.gltf.accessors[input];
    if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fault(who, ".input: ", name, " does not hold single floats");
    file.keyValues.spend(accessor.count, who);
    std::vector<float> times_s = readFloats(file.gltf, input);
    if (times_s.front() < 0) fault(name, ": the first key's time is negative");
    const auto wrong = std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal());
    if (wrong != times_s.end())
        fault(name, ": key ", wrong - times_s.begin() + 1, " is not later than the one before");
    return times_s;
}

// Normalises the rotations of all keys; the tangents of splines stay as they are.
void normaliseRotations(Channel& channel, const std::string& who) {
    const bool spline = channel.interpolation == Interpolation::CubicSpline;
    for (size_t i = spline ? 4 : 0; i < channel.values.size(); i += spline ? 12 : 4) {
        const glm::dvec4 q(glm::make_vec4(channel.values.data() + i));
        const double length = glm::length(q);
        if (!(length > 1e-6)) fault(who, ": a rotation is no quaternion of length 1");
        for (int k = 0; k < 4; ++k) channel.values[i + k] = static_cast<float>(q[k] / length);
    }
}

void readValues(GltfFile& file, int output, const TargetKind& kind, size_t perKey, Channel& channel,
                const std::string& who) {
    const std::string name = element("accessors", output);
    const tinygltf::Accessor& accessor = file.gltf.accessors[output];
    const bool floats = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (accessor.type != kind.type || !(floats || (kind.mayBeInteger && accessor.normalized)))
        fault(who, ".output: ", name, " has a type that its channel cannot take");
    const size_t numbers = accessor.count * componentCount(accessor);
    const size_t perValue = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    const size_t needed = channel.times_s.size() * perKey * perValue;
    if (numbers != needed) fault(who, ".output: ", name, " has ", numbers, " numbers instead of ", needed);
    file.keyValues.spend(numbers, who);
    channel.values = readFloats(file.gltf, output);
    if (channel.target == Target::Rotation) normaliseRotations(channel, name);
}

// Reads a channel. animationName: "animations[0]"; who: the channel's name in messages.
std::optional<Channel> readChannel(GltfFile& file, const Model& model, const tinygltf::Animation& animation,
                                   const tinygltf::AnimationChannel& from, const std::string& animationName,
                                   const std::string& who) {
    const auto samplers = static_cast<int>(animation.samplers.size());
    if (from.sampler >= samplers)
        fault(who, ".sampler is ", from.sampler, ", but there are ", samplers, " samplers");
    const auto found = kTargets.find(from.target_path);
    if (found == kTargets.end()) {
        file.warn(who, ".target.path is ", quoted(from.target_path), "; the channel is ignored");
        return std::nullopt;
    }
    if (from.target_node < 0) return std::nullopt;
    const TargetKind& kind = found->second;
    Channel channel{.target = kind.target, .node = from.target_node};
    const Node& node = model.nodes[channel.node];
    const size_t weights = node.mesh < 0 ? 0 : model.meshes[node.mesh].morphWeights.size();
    if (kind.target == Target::Weights && weights == 0)
        fault(who, " moves the weights of ", element("nodes", channel.node), ", which has no morph targets");
    if (kind.target != Target::Weights && node.matrix)
        fault(who, " moves ", element("nodes", channel.node), ", whose matrix cannot be split");

    const tinygltf::AnimationSampler& sampler = animation.samplers[from.sampler];
    const std::string samplerName = animationName + "." + element("samplers", from.sampler);
    channel.interpolation = interpolationOf(sampler.interpolation, samplerName);
    channel.times_s = readTimes(file, sampler.input, samplerName);
    const size_t perKey = kind.target == Target::Weights ? weights : kind.target == Target::Rotation ? 4 : 3;
    readValues(file, sampler.output, kind, perKey, channel, samplerName);
    return channel;
}

} // namespace

void readNodes(GltfFile& file, Model& model) {
    const tinygltf::Model& gltf = file.gltf;
    for (const tinygltf::Node& node : gltf.nodes)
        model.nodes.push_back(readNode(file, node, element("nodes", model.nodes.size())));
    const std::vector<int> roots = joinParents(model);
    model.order = withDescendants(model, gltf.scenes.empty() ? roots : sceneRoots(gltf, model));
    for (const tinygltf::Skin& skin : gltf.skins)
        model.skins.push_back(readSkin(file, skin, element("skins", model.skins.size())));
    checkJointsInScene(model);
}

void readAnimations(GltfFile& file, Model& model) {
    for (const tinygltf::Animation& from : file.gltf.animations) {
        const std::string who = element("animations", model.animations.size());
        Animation& animation = model.animations.emplace_back(Animation{.name = from.name});
        std::set<std::pair<int, Target>> moved;
        for (size_t i = 0; i < from.channels.size(); ++i) {
            const std::string name = who + "." + element("channels", i);
            auto channel = readChannel(file, model, from, from.channels[i], who, name);
            if (!channel) continue;
            if (!moved.emplace(channel->node, channel->target).second)
                fault(name, " moves the same property of ", element("nodes", channel->node),
                      " as one before it");
            animation.duration_s = std::max(animation.duration_s, channel->times_s.back());
            animation.channels.push_back(std::move(*channel));
        }
    }
}

} // namespace shoal::scene
