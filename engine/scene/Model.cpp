#include "engine/scene/Model.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>

namespace shoal::scene {

namespace {

template <class Named> int findNamed(const std::vector<Named>& list, const std::string& name) {
    const auto found = std::ranges::find(list, name, &Named::name);
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

// T * R * S, glTF 2.0 specification 3.5.3.
glm::mat4 matrixOf(const Transform& t) {
    glm::mat4 matrix = glm::mat4_cast(t.rotation);
    for (int i = 0; i < 3; ++i) matrix[i] *= t.scale[i];
    matrix[3] = glm::vec4(t.translation, 1);
    return matrix;
}

// Interpolation of keys: glTF 2.0 specification, appendix C "Animation Sampler Interpolation Modes".

using Interpolation = Channel::Interpolation;

// Position of a time among the keys of a channel.
struct Moment {
    size_t key = 0;       // the last key not after it
    float fraction = 0;   // 0 .. 1 of the way to the next
    float duration_s = 0; // between the two; 0 outside the keys
};

Moment momentAt(const std::vector<float>& times_s, float time_s) {
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s);
    if (after == times_s.begin()) return {};
    const auto key = static_cast<size_t>(after - times_s.begin()) - 1;
    if (after == times_s.end()) return {key, 0, 0};
    const float duration_s = times_s[key + 1] - times_s[key];
    return {key, (time_s - times_s[key]) / duration_s, duration_s};
}

// Returns one of the `size` components of the value at this moment; not for linear rotations.
float sampled(const Channel& channel, const Moment& at, size_t size, size_t component) {
    const float* values = channel.values.data();
    if (channel.interpolation != Interpolation::CubicSpline) {
        const float here = values[at.key * size + component];
        if (channel.interpolation == Interpolation::Step || at.duration_s == 0) return here;
        return glm::mix(here, values[(at.key + 1) * size + component], at.fraction);
    }
    // A key holds in-tangent, value and out-tangent, weighted by the Hermite basis functions.
    const float* here = values + at.key * 3 * size;
    if (at.duration_s == 0) return here[size + component];
    const float* next = here + 3 * size;
    const float t = at.fraction, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * here[size + component] +
           at.duration_s * (t3 - 2 * t2 + t) * here[2 * size + component] +
           (3 * t2 - 2 * t3) * next[size + component] + at.duration_s * (t3 - t2) * next[component];
}

glm::quat quaternionAt(const Channel& channel, size_t key) {
    const float* q = channel.values.data() + 4 * key;
    return {q[3], q[0], q[1], q[2]};
}

glm::quat sampledRotation(const Channel& channel, const Moment& at) {
    if (channel.interpolation == Interpolation::Linear &&
        at.duration_s != 0) // glm's slerp takes the shorter way
        return glm::normalize(
            glm::slerp(quaternionAt(channel, at.key), quaternionAt(channel, at.key + 1), at.fraction));
    return glm::normalize(glm::quat(sampled(channel, at, 4, 3), sampled(channel, at, 4, 0),
                                    sampled(channel, at, 4, 1), sampled(channel, at, 4, 2)));
}

} // namespace

int Model::findAnimation(const std::string& name) const { return findNamed(animations, name); }
int Model::findNode(const std::string& name) const { return findNamed(nodes, name); }

const Material& Model::materialOf(const Primitive& primitive) const {
    static const Material kDefault;
    return primitive.material < 0 ? kDefault : materials[primitive.material];
}

const ImageRgba8* Model::imageOf(const TextureUse& use) const {
    const int image = use.texture < 0 ? -1 : textures[use.texture].image;
    return image < 0 ? nullptr : &images[image];
}

void restPose(const Model& model, Pose& pose) {
    const size_t count = model.nodes.size();
    pose.local.resize(count);
    pose.modelFromNode.resize(count, glm::mat4(1));
    pose.morphWeights.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const Node& node = model.nodes[i];
        pose.local[i] = node.parentFromNode;
        const bool own = node.mesh < 0 || !node.morphWeights.empty();
        pose.morphWeights[i] = own ? node.morphWeights : model.meshes[node.mesh].morphWeights;
    }
    updateGlobals(model, pose);
}

void updateGlobals(const Model& model, Pose& pose) {
    assert(pose.local.size() == model.nodes.size());
    for (const int i : model.order) {
        const Node& node = model.nodes[i];
        const glm::mat4 parentFromNode = node.matrix ? *node.matrix : matrixOf(pose.local[i]);
        pose.modelFromNode[i] =
            node.parent < 0 ? parentFromNode : pose.modelFromNode[node.parent] * parentFromNode;
    }
}

void skinMatrices(const Model& model, int skin, const Pose& pose, std::vector<glm::mat4>& out) {
    const Skin& from = model.skins[skin];
    out.resize(from.joints.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = pose.modelFromNode[from.joints[i]] * from.jointFromMesh[i];
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

void animate(const Model& model, int animation, float time_s, Pose& pose, float weight) {
    assert(pose.local.size() == model.nodes.size());
    for (const Channel& channel : model.animations[animation].channels) {
        const Moment at = momentAt(channel.times_s, time_s);
        Transform& local = pose.local[channel.node];
        if (channel.target == Channel::Target::Weights) {
            std::vector<float>& weights = pose.morphWeights[channel.node];
            for (size_t i = 0; i < weights.size(); ++i)
                weights[i] = glm::mix(weights[i], sampled(channel, at, weights.size(), i), weight);
        } else if (channel.target == Channel::Target::Rotation) {
            const glm::quat rotation = sampledRotation(channel, at);
            local.rotation =
                weight == 1 ? rotation : glm::normalize(glm::slerp(local.rotation, rotation, weight));
        } else {
            glm::vec3& moved = channel.target == Channel::Target::Scale ? local.scale : local.translation;
            for (int i = 0; i < 3; ++i) moved[i] = glm::mix(moved[i], sampled(channel, at, 3, i), weight);
        }
    }
}

} // namespace shoal::scene
