#include "engine/scene/Gltf.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace shoal::scene {

namespace {

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
    Channel channel;
    channel.node = from.target_node;
    channel.target = kind.target;
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

void readAnimations(GltfFile& file, Model& model) {
    for (const tinygltf::Animation& from : file.gltf.animations) {
        const std::string who = element("animations", model.animations.size());
        Animation& animation = model.animations.emplace_back();
        animation.name = from.name;
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
