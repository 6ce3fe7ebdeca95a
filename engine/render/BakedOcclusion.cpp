#include "engine/render/BakedOcclusion.h"

#include "engine/core/Hash.h"
#include "engine/core/Number.h"

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace shoal::render {

namespace {

using nlohmann::json;

constexpr size_t kMaxParts = 64;
constexpr float kMax_m = 100; // largest magnitude of a centre's coordinate or a semi-axis
constexpr uint64_t kMaxBytes = 8u << 20;

template <class T> void addAll(Hash& hash, const std::vector<T>& values) {
    hash.add(static_cast<uint64_t>(values.size()));
    for (const T& value : values) hash.bytes(&value, sizeof value);
}

// Calls `each` for every primitive that is drawn, in the order of the nodes.
template <class Model, class Each> void eachPrimitive(Model& model, Each&& each) {
    for (const int index : model.order) {
        const int mesh = model.nodes[static_cast<size_t>(index)].mesh;
        if (mesh < 0) continue;
        for (auto& primitive : model.meshes[static_cast<size_t>(mesh)].primitives) each(primitive);
    }
}

// Throws, like the functions below, unless the list has kCount numbers of at most this magnitude.
template <int kCount> glm::vec<kCount, float> vectorFrom(const json& list, float maximum) {
    const auto numbers = list.get<std::vector<float>>();
    if (numbers.size() != kCount) throw std::length_error("has a vector of another length");
    glm::vec<kCount, float> v(0);
    for (int i = 0; i < kCount; ++i) {
        v[i] = numbers[static_cast<size_t>(i)];
        if (!isWithin(v[i], -maximum, maximum)) throw std::out_of_range("has a number out of range");
    }
    return v;
}

occlusion::BodyPart partFrom(const json& part) {
    const glm::vec4 turn = vectorFrom<4>(part.at("turn"), 1.001f);
    const glm::quat axes(turn.w, turn.x, turn.y, turn.z);
    const json& node = part.at("node");
    const occlusion::Ellipsoid shape{vectorFrom<3>(part.at("centre"), kMax_m),
                                     glm::mat3_cast(glm::normalize(axes)),
                                     vectorFrom<3>(part.at("semiAxes"), kMax_m)};
    const glm::vec3& semi = shape.semiAxes;
    if (!node.is_number_unsigned() || node.get<uint64_t>() > UINT16_MAX ||
        std::abs(glm::length(axes) - 1) > 1e-3f || !(std::min({semi.x, semi.y, semi.z}) > 0))
        throw std::out_of_range("has an ellipsoid out of range");
    return {shape, node.get<uint16_t>()};
}

std::vector<glm::vec4> selfOcclusionFrom(const json& list) {
    if (list.size() % 4 != 0) throw std::length_error("has a self-occlusion cut short");
    std::vector<glm::vec4> selfOcclusion(list.size() / 4);
    for (size_t i = 0; i < list.size(); ++i) {
        const auto step = list.at(i).get<double>(); // a double: integers do not wrap around in it
        if (!list[i].is_number_integer() || std::abs(step) > kMaxSelfOcclusionSteps)
            throw std::out_of_range("has a self-occlusion out of range");
        selfOcclusion[i / 4][static_cast<int>(i % 4)] = static_cast<float>(step / kSelfOcclusionSteps);
    }
    return selfOcclusion;
}

} // namespace

uint64_t skinHash(const scene::Model& model) {
    Hash hash;
    eachPrimitive(model, [&](const scene::Primitive& primitive) {
        addAll(hash, primitive.positions);
        addAll(hash, primitive.normals);
        addAll(hash, primitive.indices);
        addAll(hash, primitive.joints);
        addAll(hash, primitive.weights);
    });
    for (const scene::Skin& skin : model.skins) addAll(hash, skin.joints), addAll(hash, skin.jointFromMesh);
    return hash.value();
}

Path bakedOcclusionBeside(const Path& model) { return Path(model).replace_extension(".occlusion.json"); }

Result<BakedOcclusion> parseBakedOcclusion(std::string_view text) {
    try {
        const json read = json::parse(text);
        const auto skin = read.at("skin").get<std::string>();
        BakedOcclusion baked{std::strtoull(skin.c_str(), nullptr, 16), {}, {}, {}};
        if (skin != fmt::format("{:016x}", baked.skin)) return Error{{}, "does not say whose it is"};
        const json& ellipsoids = read.at("ellipsoids");
        if (ellipsoids.size() > kMaxParts) return Error{{}, "has more than 64 ellipsoids"};
        for (const json& each : ellipsoids) baked.parts.push_back(partFrom(each));
        baked.selfOcclusion = selfOcclusionFrom(read.at("selfOcclusion"));
        baked.besideOwn = selfOcclusionFrom(read.at("selfOcclusionBesideOwn"));
        if (!baked.besideOwn.empty() && baked.besideOwn.size() != baked.selfOcclusion.size())
            return Error{{}, "has no self-occlusion for each vertex"};
        return baked;
    } catch (const std::exception& problem) {
        return Error{{}, std::string("is no baked occlusion: ") + problem.what()};
    }
}

Result<BakedOcclusion> readBakedOcclusion(const Path& file) {
    const auto text = readText(file, kMaxBytes);
    if (!text) return text.error();
    auto baked = parseBakedOcclusion(*text);
    if (!baked) return Error{file.string(), baked.error().reason};
    return baked;
}

bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model) {
    for (const occlusion::BodyPart& part : baked.parts)
        if (part.joint >= model.nodes.size()) return false;
    if (baked.skin != skinHash(model)) return false;
    size_t vertices = 0, next = 0;
    eachPrimitive(model, [&](const scene::Primitive& primitive) { vertices += primitive.positions.size(); });
    if (baked.selfOcclusion.size() != vertices) return false;
    const auto part = [&](const std::vector<glm::vec4>& all, size_t count) {
        if (all.empty()) return all;
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(next);
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        const bool none = std::all_of(begin, end, [](const glm::vec4& each) { return each == glm::vec4(0); });
        return none ? std::vector<glm::vec4>() : std::vector(begin, end);
    };
    eachPrimitive(model, [&](scene::Primitive& primitive) {
        primitive.selfOcclusion = part(baked.selfOcclusion, primitive.positions.size());
        primitive.selfOcclusionBesideOwn = part(baked.besideOwn, primitive.positions.size());
        next += primitive.positions.size();
    });
    return true;
}

} // namespace shoal::render
