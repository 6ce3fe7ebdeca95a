#include "engine/scene/ReadAnimations.h"

#include "engine/scene/Accessors.h"
#include "engine/scene/Document.h"
#include "engine/scene/Loading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

namespace shoal::scene {

namespace {

using Interpolation = Channel::Interpolation;
using Target = Channel::Target;

std::optional<Target> targetOf(const std::string& path) {
    if (path == "translation") return Target::Translation;
    if (path == "rotation") return Target::Rotation;
    if (path == "scale") return Target::Scale;
    if (path == "weights") return Target::Weights;
    return std::nullopt;
}

Interpolation interpolationOf(const std::string& name, const std::string& who) {
    if (name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    fault(who, ".interpolation is ", quoted(name), ", none of glTF");
}

size_t morphTargetCount(const Model& model, const Node& node) {
    return node.mesh < 0 ? 0 : model.meshes[static_cast<size_t>(node.mesh)].morphWeights.size();
}

// Numbers in one value of the channel.
size_t valueSize(const Model& model, const Channel& channel) {
    switch (channel.target) {
    case Target::Translation:
    case Target::Scale:
        return 3;
    case Target::Rotation:
        return 4;
    case Target::Weights:
        break;
    }
    return morphTargetCount(model, model.nodes[static_cast<size_t>(channel.node)]);
}

void readTimes(Loading& loading, const tinygltf::Model& gltf, int input, Channel& channel,
               const std::string& who) {
    const tinygltf::Accessor& accessor = gltf.accessors[static_cast<size_t>(input)];
    if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fault(who, ".input: ", element("accessors", input), " does not hold single floats");
    Loading::spend(loading.keyValues, accessor.count, loading.limits.maxKeyValues, who, "key values");
    channel.times_s = readFloats(gltf, input);
    if (channel.times_s.front() < 0) fault(element("accessors", input), ": the first key's time is negative");
    const auto wrong =
        std::adjacent_find(channel.times_s.begin(), channel.times_s.end(), std::greater_equal());
    if (wrong != channel.times_s.end())
        fault(element("accessors", input), ": key ", wrong - channel.times_s.begin() + 1,
              " is not later than the one before");
}

void checkOutputType(const tinygltf::Accessor& accessor, Target target, const std::string& who) {
    const int type = target == Target::Weights    ? TINYGLTF_TYPE_SCALAR
                     : target == Target::Rotation ? TINYGLTF_TYPE_VEC4
                                                  : TINYGLTF_TYPE_VEC3;
    const bool floats = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool mayBeInteger = target == Target::Weights || target == Target::Rotation;
    if (accessor.type != type || !(floats || (mayBeInteger && accessor.normalized)))
        fault(who, " has a type that its channel cannot take");
}

// Spline tangents, which lie beside each value, keep their length.
void normaliseRotations(Channel& channel, const std::string& who) {
    const size_t stride = channel.interpolation == Interpolation::CubicSpline ? 12 : 4;
    const size_t first = channel.interpolation == Interpolation::CubicSpline ? 4 : 0;
    for (size_t i = first; i < channel.values.size(); i += stride) {
        float* q = channel.values.data() + i;
        const double length =
            std::sqrt(double{q[0]} * q[0] + double{q[1]} * q[1] + double{q[2]} * q[2] + double{q[3]} * q[3]);
        if (!(length > 1e-6)) fault(who, ": rotation ", i / stride, " is no quaternion of length 1");
        for (int k = 0; k < 4; ++k) q[k] = static_cast<float>(q[k] / length);
    }
}

void readValues(Loading& loading, const tinygltf::Model& gltf, int output, size_t perKey, Channel& channel,
                const std::string& who) {
    const std::string name = element("accessors", output);
    const tinygltf::Accessor& accessor = gltf.accessors[static_cast<size_t>(output)];
    checkOutputType(accessor, channel.target, who + ".output: " + name);
    const uint64_t numbers = uint64_t{accessor.count} * static_cast<uint64_t>(componentCount(accessor));
    const uint64_t needed = uint64_t{channel.times_s.size()} * perKey *
                            (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (numbers != needed) fault(who, ".output: ", name, " has ", numbers, " numbers instead of ", needed);
    Loading::spend(loading.keyValues, numbers, loading.limits.maxKeyValues, who, "key values");
    channel.values = readFloats(gltf, output);
    if (channel.target == Target::Rotation) normaliseRotations(channel, name);
}

std::optional<Channel> readChannel(Loading& loading, const Document& document, const Model& model,
                                   const tinygltf::Animation& animation,
                                   const tinygltf::AnimationChannel& from, const std::string& animationName,
                                   const std::string& who) {
    const tinygltf::Model& gltf = document.gltf;
    if (from.sampler < 0 || static_cast<size_t>(from.sampler) >= animation.samplers.size())
        fault(who, ".sampler is ", from.sampler, ", but there are ", animation.samplers.size(), " samplers");
    const std::optional<Target> target = targetOf(from.target_path);
    if (!target) {
        loading.warn(who, ".target.path is ", quoted(from.target_path), "; the channel is ignored");
        return std::nullopt;
    }
    if (from.target_node < 0) return std::nullopt;
    Channel channel;
    channel.node = from.target_node;
    channel.target = *target;
    const Node& node = model.nodes[static_cast<size_t>(channel.node)];
    const size_t perKey = valueSize(model, channel);
    if (channel.target == Target::Weights && perKey == 0)
        fault(who, " moves the weights of ", element("nodes", channel.node), ", which has no morph targets");
    if (channel.target != Target::Weights && node.matrix)
        fault(who, " moves ", element("nodes", channel.node), ", whose matrix cannot be split");

    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<size_t>(from.sampler)];
    const std::string samplerName = text(animationName, ".", element("samplers", from.sampler));
    channel.interpolation = interpolationOf(sampler.interpolation, samplerName);
    readTimes(loading, gltf, sampler.input, channel, samplerName);
    readValues(loading, gltf, sampler.output, perKey, channel, samplerName);
    return channel;
}

} // namespace

void readAnimations(Loading& loading, const Document& document, Model& model) {
    for (const tinygltf::Animation& from : document.gltf.animations) {
        const std::string who = element("animations", static_cast<int64_t>(model.animations.size()));
        Animation& animation = model.animations.emplace_back();
        animation.name = from.name;
        std::set<std::pair<int, Target>> moved;
        for (size_t i = 0; i < from.channels.size(); ++i) {
            const std::string name = text(who, ".", element("channels", static_cast<int64_t>(i)));
            auto channel = readChannel(loading, document, model, from, from.channels[i], who, name);
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
