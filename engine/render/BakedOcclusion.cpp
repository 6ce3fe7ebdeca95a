#include "engine/render/BakedOcclusion.h"

#include "engine/core/Hash.h"
#include "engine/occlusion/TraceSelfOcclusion.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace shoal::render {

namespace {

// Turned and not scaled.
glm::vec4 turned(const glm::mat3& by, const glm::vec4& selfOcclusion) {
    const glm::vec3 to = by * glm::vec3(selfOcclusion);
    const float length = glm::length(to);
    return {length > 0 ? to * (glm::length(glm::vec3(selfOcclusion)) / length) : glm::vec3(0),
            selfOcclusion.w};
}

void selfOcclusion(scene::Model& model, const scene::Pose& pose, std::span<const occlusion::Occluder> own,
                   int rays, std::vector<glm::vec4> scene::Primitive::*kept) {
    const scene::Surface surface = scene::posedSurface(model, pose);
    const std::vector<uint32_t> solid = scene::opaqueTriangles(model, surface);
    const auto selfOcclusion =
        occlusion::traceSelfOcclusion({surface.positions, surface.normals, solid}, own, rays);
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
                glm::mat4 modelFromMesh = pose.modelFromNode[n];
                if (node.skin >= 0 && !primitive.joints.empty()) {
                    modelFromMesh = glm::mat4(0);
                    for (int k = 0; k < 4; ++k)
                        modelFromMesh += primitive.weights[v][k] * joints[primitive.joints[v][k]];
                }
                (primitive.*kept)[v] = turned(glm::inverse(glm::mat3(modelFromMesh)), selfOcclusion[next]);
            }
        }
    }
}

using nlohmann::json;

constexpr double kSteps = 250;  // of a self-occlusion's numbers: a tenth of what rays leave open
constexpr int kMaxSteps = 2000; // either way: what is hidden is whole long before
constexpr size_t kMaxParts = 64;
constexpr float kMax_m = 100;   // of a centre's coordinates and a semi-axis
constexpr double kDigits = 1e7; // of all other numbers
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

std::string hexOf(uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

json numbers(const float* values, int count) {
    json list = json::array();
    for (int i = 0; i < count; ++i)
        list.push_back(std::round(static_cast<double>(values[i]) * kDigits) / kDigits);
    return list;
}

json steps(const std::vector<glm::vec4>& selfOcclusion) {
    json list = json::array();
    for (const glm::vec4& vertex : selfOcclusion)
        for (int i = 0; i < 4; ++i)
            list.push_back(std::clamp(static_cast<int>(std::lround(static_cast<double>(vertex[i]) * kSteps)),
                                      -kMaxSteps, kMaxSteps));
    return list;
}

// Nothing where there is no such list of so many numbers below `most`.
template <int kCount>
std::optional<glm::vec<kCount, float>> vectorFrom(const json& part, const char* key, float maximum) {
    const auto list = part.find(key);
    if (list == part.end() || !list->is_array() || list->size() != kCount) return std::nullopt;
    glm::vec<kCount, float> v(0);
    for (int i = 0; i < kCount; ++i) {
        const json& number = (*list)[static_cast<size_t>(i)];
        if (!number.is_number()) return std::nullopt;
        v[i] = number.get<float>();
        if (!(std::abs(v[i]) <= maximum)) return std::nullopt;
    }
    return v;
}

std::optional<occlusion::BodyPart> partFrom(const json& part) {
    if (!part.is_object()) return std::nullopt;
    const auto node = part.find("node");
    const auto centre = vectorFrom<3>(part, "centre", kMax_m), semi = vectorFrom<3>(part, "semiAxes", kMax_m);
    const auto turn = vectorFrom<4>(part, "turn", 1.001f);
    if (node == part.end() || !node->is_number_unsigned() || !centre || !semi || !turn) return std::nullopt;
    const auto joint = node->get<uint64_t>();
    const float length = glm::length(*turn);
    if (joint > UINT16_MAX || !(std::min({semi->x, semi->y, semi->z}) > 0) || std::abs(length - 1) > 1e-3f)
        return std::nullopt;
    const glm::quat axes(turn->w / length, turn->x / length, turn->y / length, turn->z / length);
    return occlusion::BodyPart{{*centre, glm::mat3_cast(axes), *semi}, static_cast<uint16_t>(joint)};
}

std::optional<std::vector<glm::vec4>> selfOcclusionFrom(const json& baked, const char* key) {
    const auto list = baked.find(key);
    if (list == baked.end() || !list->is_array() || list->size() % 4 != 0) return std::nullopt;
    std::vector<glm::vec4> selfOcclusion(list->size() / 4);
    for (size_t i = 0; i < list->size(); ++i) {
        const json& number = (*list)[i];
        if (!number.is_number_integer()) return std::nullopt;
        const auto step = number.get<double>(); // which no integer wraps around in
        if (std::abs(step) > kMaxSteps) return std::nullopt;
        selfOcclusion[i / 4][static_cast<int>(i % 4)] = static_cast<float>(step / kSteps);
    }
    return selfOcclusion;
}

} // namespace

void bakeSelfOcclusion(scene::Model& model, const scene::Pose& rest, int rays) {
    selfOcclusion(model, rest, {}, rays, &scene::Primitive::selfOcclusion);
}

void bakeSelfOcclusionBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body,
                                int rays) {
    std::vector<occlusion::Occluder> own;
    for (const BodyOccluders::Part& part : body.parts)
        own.push_back({placed(part, bent, glm::mat4(1)), 1, {}});
    selfOcclusion(model, bent, own, rays, &scene::Primitive::selfOcclusionBesideOwn);
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
    const auto fail = [](const char* reason) { return Error{{}, reason}; };
    const json read = json::parse(text, nullptr, false);
    if (!read.is_object()) return fail("is no baked occlusion");
    BakedOcclusion baked;
    const auto skin = read.find("skin"), ellipsoids = read.find("ellipsoids");
    if (skin == read.end() || !skin->is_string()) return fail("does not say whose it is");
    const auto hex = skin->get<std::string>();
    baked.skin = std::strtoull(hex.c_str(), nullptr, 16);
    if (hex != hexOf(baked.skin)) return fail("does not say whose it is");
    if (ellipsoids == read.end() || !ellipsoids->is_array() || ellipsoids->size() > kMaxParts)
        return fail("has no list of at most 64 ellipsoids");
    for (const json& each : *ellipsoids) {
        const auto part = partFrom(each);
        if (!part) return fail("has an ellipsoid out of range");
        baked.parts.push_back(*part);
    }
    auto selfOcclusion = selfOcclusionFrom(read, "selfOcclusion"),
         besideOwn = selfOcclusionFrom(read, "selfOcclusionBesideOwn");
    if (!selfOcclusion || !besideOwn || selfOcclusion->size() != besideOwn->size())
        return fail("has no self-occlusion for each vertex");
    baked.selfOcclusion = std::move(*selfOcclusion), baked.besideOwn = std::move(*besideOwn);
    return baked;
}

Result<BakedOcclusion> readBakedOcclusion(const Path& file) {
    const auto text = readText(file, kMaxBytes);
    if (!text) return text.error();
    auto baked = parseBakedOcclusion(*text);
    if (!baked) return Error{file.string(), baked.error().reason};
    return baked;
}

std::string written(const BakedOcclusion& baked) {
    std::string text = "{\"skin\": \"" + hexOf(baked.skin) + "\",\n\"ellipsoids\": [";
    for (size_t k = 0; k < baked.parts.size(); ++k) {
        const occlusion::Ellipsoid& shape = baked.parts[k].atRest;
        const glm::quat turn = glm::normalize(glm::quat_cast(shape.worldFromAxes));
        const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
        const json part = {{"node", baked.parts[k].joint},
                           {"centre", numbers(&shape.centre.x, 3)},
                           {"turn", numbers(xyzw, 4)},
                           {"semiAxes", numbers(&shape.semiAxes.x, 3)}};
        text += (k ? ",\n" : "\n") + part.dump();
    }
    return text + "],\n\"selfOcclusion\": " + steps(baked.selfOcclusion).dump() +
           ",\n\"selfOcclusionBesideOwn\": " + steps(baked.besideOwn).dump() + "}\n";
}

BakedOcclusion bakedOcclusionOf(const scene::Model& model, std::vector<occlusion::BodyPart> parts) {
    BakedOcclusion baked{skinHash(model), std::move(parts), {}, {}};
    eachPrimitive(model, [&](const scene::Primitive& primitive) {
        baked.selfOcclusion.insert(baked.selfOcclusion.end(), primitive.selfOcclusion.begin(),
                                   primitive.selfOcclusion.end());
        baked.besideOwn.insert(baked.besideOwn.end(), primitive.selfOcclusionBesideOwn.begin(),
                               primitive.selfOcclusionBesideOwn.end());
    });
    return baked;
}

bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model) {
    size_t vertices = 0;
    eachPrimitive(model, [&](const scene::Primitive& primitive) { vertices += primitive.positions.size(); });
    if (baked.selfOcclusion.size() != vertices || baked.besideOwn.size() != vertices) return false;
    for (const occlusion::BodyPart& part : baked.parts)
        if (part.joint >= model.nodes.size()) return false;
    if (baked.skin != skinHash(model)) return false;
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
