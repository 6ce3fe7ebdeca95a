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
    const char* type;  // of the accessor with its values
    bool mayBeInteger; // normalized
};
const std::map<std::string, TargetKind> kTargets = {{"translation", {Target::Translation, "VEC3", false}},
                                                    {"rotation", {Target::Rotation, "VEC4", true}},
                                                    {"scale", {Target::Scale, "VEC3", false}},
                                                    {"weights", {Target::Weights, "SCALAR", true}}};

Interpolation interpolationOf(const std::string& name, const std::string& who) {
    if (name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    fault(who, ".interpolation is ", quoted(name), ", none of glTF");
}

std::vector<float> readTimes(GltfFile& file, size_t input, const std::string& who) {
    const std::string name = element("accessors", input);
    const Accessor& accessor = file.accessors[input];
    if (accessor.type != "SCALAR" || accessor.componentType != kFloat)
        fault(who, ".input: ", name, " does not hold single floats");
    file.keyValues.spend(accessor.count, who);
    std::vector<float> times_s = readFloats(file, input);
    if (times_s.front() < 0) fault(name, ": the first key's time is negative");
    const auto wrong = std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal());
    if (wrong != times_s.end())
        fault(name, ": key ", wrong - times_s.begin() + 1, " is not later than the one before");
    return times_s;
}

// Spline tangents, which lie beside each value, keep their length.
void normaliseRotations(Channel& channel, const std::string& who) {
    const bool spline = channel.interpolation == Interpolation::CubicSpline;
    for (size_t i = spline ? 4 : 0; i < channel.values.size(); i += spline ? 12 : 4) {
        const glm::dvec4 q(glm::make_vec4(channel.values.data() + i));
        const double length = glm::length(q);
        if (!(length > 1e-6)) fault(who, ": a rotation is no quaternion of length 1");
        for (int k = 0; k < 4; ++k) channel.values[i + k] = static_cast<float>(q[k] / length);
    }
}

void readValues(GltfFile& file, size_t output, const TargetKind& kind, size_t perKey, Channel& channel,
                const std::string& who) {
    const std::string name = element("accessors", output);
    const Accessor& accessor = file.accessors[output];
    const bool floats = accessor.componentType == kFloat;
    if (accessor.type != kind.type || !(floats || (kind.mayBeInteger && accessor.normalized)))
        fault(who, ".output: ", name, " has a type that its channel cannot take");
    const size_t numbers = accessor.count * accessor.components;
    const size_t perValue = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    const size_t needed = channel.times_s.size() * perKey * perValue;
    if (numbers != needed) fault(who, ".output: ", name, " has ", numbers, " numbers instead of ", needed);
    file.keyValues.spend(numbers, who);
    channel.values = readFloats(file, output);
    if (channel.target == Target::Rotation) normaliseRotations(channel, name);
}

// animation: "animations[0]"; who: its channel.
std::optional<Channel> readChannel(GltfFile& file, const Model& model, const Json& animation,
                                   const Json& from, const std::string& animationName,
                                   const std::string& who) {
    const Json &samplers = animation["samplers"], &target = from["target"];
    const size_t index = from["sampler"];
    if (index >= samplers.size())
        fault(who, ".sampler is ", index, ", but there are ", samplers.size(), " samplers");
    const std::string path = target["path"];
    const auto found = kTargets.find(path);
    if (found == kTargets.end()) {
        file.warn(who, ".target.path is ", quoted(path), "; the channel is ignored");
        return std::nullopt;
    }
    if (!target.contains("node")) return std::nullopt;
    const TargetKind& kind = found->second;
    Channel channel;
    channel.node = target["node"];
    channel.target = kind.target;
    const Node& node = model.nodes[channel.node];
    const size_t weights = node.mesh < 0 ? 0 : model.meshes[node.mesh].morphWeights.size();
    if (kind.target == Target::Weights && weights == 0)
        fault(who, " moves the weights of ", element("nodes", channel.node), ", which has no morph targets");
    if (kind.target != Target::Weights && node.matrix)
        fault(who, " moves ", element("nodes", channel.node), ", whose matrix cannot be split");

    const Json& sampler = samplers[index];
    const std::string samplerName = animationName + "." + element("samplers", index);
    channel.interpolation = interpolationOf(sampler.value("interpolation", "LINEAR"), samplerName);
    channel.times_s = readTimes(file, sampler["input"], samplerName);
    const size_t perKey = kind.target == Target::Weights ? weights : kind.target == Target::Rotation ? 4 : 3;
    readValues(file, sampler["output"], kind, perKey, channel, samplerName);
    return channel;
}

} // namespace

void readAnimations(GltfFile& file, Model& model) {
    for (const Json& from : member(file.root, "animations")) {
        const std::string who = element("animations", model.animations.size());
        Animation& animation = model.animations.emplace_back();
        animation.name = from.value("name", "");
        std::set<std::pair<int, Target>> moved;
        const Json& channels = from["channels"];
        for (size_t i = 0; i < channels.size(); ++i) {
            const std::string name = who + "." + element("channels", i);
            auto channel = readChannel(file, model, from, channels[i], who, name);
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
