#include "engine/render/BakedOcclusion.h"

#include "engine/core/Hash.h"
#include "engine/core/Number.h"
#include "engine/occlusion/TraceSelfOcclusion.h"
#include "engine/scene/Surface.h"

#include <fmt/core.h>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace shoal::render {

namespace {

// Turned and not scaled.
glm::vec4 turned(const glm::mat3& by, const glm::vec4& selfOcclusion) {
    const glm::vec3 to = by * glm::vec3(selfOcclusion);
    const float length = glm::length(to);
    return {length > 0 ? to * (glm::length(glm::vec3(selfOcclusion)) / length) : glm::vec3(0),
            selfOcclusion.w};
}

using nlohmann::json;

constexpr size_t kMaxParts = 64;
constexpr float kMax_m = 100; // of a centre's coordinates and a semi-axis
constexpr uint64_t kMaxBytes = 8u << 20;

template <class T> void addAll(Hash& hash, const std::vector<T>& values) {
    hash.add(static_cast<uint64_t>(values.size()));
    for (const T& value : values) hash.bytes(&value, sizeof value);
}

// Every primitive that is drawn, in the order of the nodes.
template <class Model, class Each> void eachPrimitive(Model& model, Each&& each) {
    for (const int index : model.order) {
        const int mesh = model.nodes[static_cast<size_t>(index)].mesh;
        if (mesh < 0) continue;
        for (auto& primitive : model.meshes[static_cast<size_t>(mesh)].primitives) each(primitive);
    }
}

// Throws, like those below, where it is no such list of so many numbers at most this large.
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
        const auto step = list.at(i).get<double>(); // which no integer wraps around in
        if (!list[i].is_number_integer() || std::abs(step) > kMaxSelfOcclusionSteps)
            throw std::out_of_range("has a self-occlusion out of range");
        selfOcclusion[i / 4][static_cast<int>(i % 4)] = static_cast<float>(step / kSelfOcclusionSteps);
    }
    return selfOcclusion;
}

} // namespace

void bakeSelfOcclusion(scene::Model& model, const scene::Pose& pose, int rays) {
    const scene::Surface surface = scene::posedSurface(model, pose);
    keepSelfOcclusion(
        model, pose,
        occlusion::traceSelfOcclusion({surface.positions, surface.normals, surface.opaque}, rays),
        &scene::Primitive::selfOcclusion);
}

void keepSelfOcclusion(scene::Model& model, const scene::Pose& pose, std::span<const glm::vec4> traced,
                       std::vector<glm::vec4> scene::Primitive::*kept) {
    std::vector<glm::mat4> joints;
    size_t next = 0; // in the surface's order
    for (const int index : model.order) {
        const auto n = static_cast<size_t>(index);
        const scene::Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) scene::skinMatrices(model, node.skin, pose, joints);
        for (scene::Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            const bool mapped =
                primitive.material >= 0 &&
                model.materials[static_cast<size_t>(primitive.material)].occlusion.texture >= 0;
            if (mapped || scene::isBlended(model, primitive)) {
                next += primitive.positions.size();
                continue;
            }
            (primitive.*kept).resize(primitive.positions.size());
            for (size_t v = 0; v < primitive.positions.size(); ++v, ++next) {
                const bool skinned = node.skin >= 0 && !primitive.joints.empty();
                const glm::mat4 modelFromMesh =
                    skinned ? scene::skinMatrix(primitive, v, joints) : pose.modelFromNode[n];
                (primitive.*kept)[v] = turned(glm::inverse(glm::mat3(modelFromMesh)), traced[next]);
            }
        }
    }
}

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
        if (baked.selfOcclusion.size() != baked.besideOwn.size())
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
    if (baked.selfOcclusion.empty() && baked.besideOwn.empty()) return true;
    size_t vertices = 0;
    eachPrimitive(model, [&](const scene::Primitive& primitive) { vertices += primitive.positions.size(); });
    if (baked.selfOcclusion.size() != vertices || baked.besideOwn.size() != vertices) return false;
    size_t next = 0;
    eachPrimitive(model, [&](scene::Primitive& primitive) {
        const auto from = static_cast<std::ptrdiff_t>(next);
        next += primitive.positions.size();
        const auto to = static_cast<std::ptrdiff_t>(next);
        primitive.selfOcclusion.assign(baked.selfOcclusion.begin() + from, baked.selfOcclusion.begin() + to);
        primitive.selfOcclusionBesideOwn.assign(baked.besideOwn.begin() + from, baked.besideOwn.begin() + to);
    });
    return true;
}

} // namespace shoal::render
