#include "engine/scene/ReadAttributes.h"

#include "engine/scene/Accessors.h"
#include "engine/scene/Document.h"
#include "engine/scene/Loading.h"
#include "engine/scene/Vertices.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <map>
#include <span>
#include <utility>

namespace shoal::scene {

namespace {

enum Components : unsigned { // what component types an attribute may have
    kFloat = 1,
    kUnsignedNormalized = 2, // bytes and shorts
    kSignedNormalized = 4,
    kUnsignedPlain = 8,
    kSignedPlain = 16,
};

unsigned componentsOf(const tinygltf::Accessor& a) {
    switch (a.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return kFloat;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return a.normalized ? kUnsignedNormalized : kUnsignedPlain;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return a.normalized ? kSignedNormalized : kSignedPlain;
    default:
        return 0;
    }
}

template <class Vector> std::vector<Vector> packed(const std::vector<float>& numbers) {
    std::vector<Vector> vectors(numbers.size() * sizeof(float) / sizeof(Vector));
    if (!numbers.empty()) std::memcpy(vectors.data(), numbers.data(), numbers.size() * sizeof(float));
    return vectors;
}

class Attributes {
  public:
    Attributes(const Document& document, const std::map<std::string, int>& names, std::string who,
               size_t vertices)
        : document_(document), names_(names), who_(std::move(who)), vertices_(vertices) {}

    bool has(const char* name) const { return names_.contains(name); }

    const tinygltf::Accessor& accessor(const char* name) const {
        return document_.gltf.accessors[static_cast<size_t>(names_.at(name))];
    }

    // quantized: what KHR_mesh_quantization allows besides.
    std::vector<float> floats(const char* name, std::initializer_list<int> types, unsigned components,
                              unsigned quantized = 0) const {
        check(name, types, components | (document_.quantized ? quantized : 0));
        return readFloats(document_.gltf, names_.at(name));
    }

    std::vector<uint32_t> integers(const char* name, int type) const {
        check(name, {type}, kUnsignedPlain);
        return readIntegers(document_.gltf, names_.at(name));
    }

    std::string where(const char* name) const { return who_ + "." + name; }

  private:
    void check(const char* name, std::initializer_list<int> types, unsigned components) const {
        const tinygltf::Accessor& a = accessor(name);
        const std::string who = where(name) + ": " + element("accessors", names_.at(name));
        if (std::find(types.begin(), types.end(), a.type) == types.end() || !(componentsOf(a) & components))
            fault(who, " has a type that this attribute cannot have");
        if (a.count != vertices_)
            fault(who, " has ", a.count, " elements, but the primitive ", vertices_, " vertices");
    }

    const Document& document_;
    const std::map<std::string, int>& names_;
    std::string who_;
    size_t vertices_;
};

constexpr unsigned kQuantizedPositions =
    kUnsignedNormalized | kSignedNormalized | kUnsignedPlain | kSignedPlain;

void readShading(const Attributes& attributes, Loading& loading, Primitive& primitive) {
    if (attributes.has("NORMAL")) {
        primitive.normals =
            packed<glm::vec3>(attributes.floats("NORMAL", {TINYGLTF_TYPE_VEC3}, kFloat, kSignedNormalized));
        for (glm::vec3& normal : primitive.normals) {
            if (normal == glm::vec3(0))
                loading.warn(attributes.where("NORMAL"), " holds normals of no length");
            normal = safeNormalize(glm::dvec3(normal), {0, 1, 0});
        }
    }
    if (attributes.has("TANGENT") && attributes.has("NORMAL")) {
        primitive.tangents =
            packed<glm::vec4>(attributes.floats("TANGENT", {TINYGLTF_TYPE_VEC4}, kFloat, kSignedNormalized));
        for (size_t i = 0; i < primitive.tangents.size(); ++i) {
            glm::vec4& t = primitive.tangents[i];
            t = {safeNormalize(glm::dvec3(t), perpendicular(primitive.normals[i])), t.w < 0 ? -1.0f : 1.0f};
        }
    }
    constexpr const char* kSets[2] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (int set = 0; set < 2; ++set)
        if (attributes.has(kSets[set]))
            primitive.texCoords[set] = packed<glm::vec2>(
                attributes.floats(kSets[set], {TINYGLTF_TYPE_VEC2}, kFloat | kUnsignedNormalized,
                                  kUnsignedPlain | kSignedNormalized | kSignedPlain));
    if (attributes.has("COLOR_0")) {
        const auto numbers = attributes.floats("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4},
                                               kFloat | kUnsignedNormalized);
        if (attributes.accessor("COLOR_0").type == TINYGLTF_TYPE_VEC4)
            primitive.coloursLin = packed<glm::vec4>(numbers);
        else
            for (const glm::vec3& colour : packed<glm::vec3>(numbers))
                primitive.coloursLin.emplace_back(colour, 1.0f);
    }
}

struct Influences {
    std::vector<uint32_t> joints;
    std::vector<float> weights; // four a vertex each
};

Influences readInfluences(const Attributes& attributes, const char* joints, const char* weights) {
    if (!attributes.has(joints) || !attributes.has(weights))
        fault(attributes.where(attributes.has(joints) ? joints : weights), " is there without ",
              attributes.has(joints) ? weights : joints);
    return {attributes.integers(joints, TINYGLTF_TYPE_VEC4),
            attributes.floats(weights, {TINYGLTF_TYPE_VEC4}, kFloat | kUnsignedNormalized)};
}

// The four heaviest influences of a vertex, scaled to the sum 1. A vertex without any hangs on its first
// joint.
void setInfluences(Primitive& primitive, size_t vertex, std::span<std::pair<float, uint32_t>> influences) {
    std::stable_sort(influences.begin(), influences.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    influences = influences.first(4);
    double sum = 0;
    for (const auto& [weight, joint] : influences) sum += weight;
    for (int k = 0; k < 4; ++k) {
        const auto& [weight, joint] = influences[static_cast<size_t>(k)];
        primitive.joints[vertex][k] = static_cast<uint16_t>(joint);
        primitive.weights[vertex][k] = sum > 0 ? static_cast<float>(weight / sum) : (k == 0 ? 1.0f : 0.0f);
    }
}

void readSkinning(const Attributes& attributes, Loading& loading, Primitive& primitive) {
    if (!attributes.has("JOINTS_0") && !attributes.has("WEIGHTS_0")) return;
    std::vector<Influences> sets = {readInfluences(attributes, "JOINTS_0", "WEIGHTS_0")};
    if (attributes.has("JOINTS_1") || attributes.has("WEIGHTS_1")) {
        sets.push_back(readInfluences(attributes, "JOINTS_1", "WEIGHTS_1"));
        loading.warn(attributes.where("JOINTS_1"), ": the four heaviest joints of each vertex are kept");
    }
    primitive.joints.resize(primitive.positions.size());
    primitive.weights.resize(primitive.positions.size());
    std::array<std::pair<float, uint32_t>, 8> influences;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        size_t count = 0;
        bool any = false;
        for (const Influences& set : sets)
            for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
                if (set.weights[k] < 0)
                    fault(attributes.where("WEIGHTS_0"), ": vertex ", v, " has a negative weight");
                any = any || set.weights[k] > 0;
                influences[count++] = {set.weights[k], set.joints[k]};
            }
        if (!any) loading.warn(attributes.where("WEIGHTS_0"), " holds vertices without any weight");
        setInfluences(primitive, v, std::span(influences).first(count));
    }
}

MorphTarget readMorphTarget(const Attributes& attributes) {
    MorphTarget target;
    const auto deltas = [&](const char* name, unsigned quantized) {
        return packed<glm::vec3>(attributes.floats(name, {TINYGLTF_TYPE_VEC3}, kFloat, quantized));
    };
    if (attributes.has("POSITION")) target.positions = deltas("POSITION", kSignedNormalized | kSignedPlain);
    if (attributes.has("NORMAL")) target.normals = deltas("NORMAL", kSignedNormalized);
    if (attributes.has("TANGENT")) target.tangents = deltas("TANGENT", kSignedNormalized);
    return target;
}

} // namespace

Primitive readAttributes(Loading& loading, const Document& document, const tinygltf::Primitive& from,
                         const std::string& who) {
    const int positions = from.attributes.at("POSITION");
    const size_t vertices = document.gltf.accessors[static_cast<size_t>(positions)].count;
    Loading::spend(loading.vertices, vertices, loading.limits.maxVertices, who, "vertices");
    for (size_t t = 0; t < from.targets.size(); ++t)
        Loading::spend(loading.vertices, vertices, loading.limits.maxVertices,
                       text(who, ".", element("targets", static_cast<int64_t>(t))), "vertices");

    Primitive primitive;
    const Attributes attributes(document, from.attributes, who, vertices);
    primitive.positions =
        packed<glm::vec3>(attributes.floats("POSITION", {TINYGLTF_TYPE_VEC3}, kFloat, kQuantizedPositions));
    readShading(attributes, loading, primitive);
    readSkinning(attributes, loading, primitive);
    for (size_t t = 0; t < from.targets.size(); ++t)
        primitive.morphTargets.push_back(
            readMorphTarget({document, from.targets[t],
                             text(who, ".", element("targets", static_cast<int64_t>(t))), vertices}));
    return primitive;
}

} // namespace shoal::scene
