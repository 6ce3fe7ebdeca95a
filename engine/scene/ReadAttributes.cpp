#include "engine/scene/Gltf.h"
#include "engine/scene/Vertices.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <map>
#include <utility>

namespace shoal::scene {

namespace {

// Integers that an attribute may hold instead of floats: none, or unsigned ones normalised to 0 .. 1.
enum class Integers { None, Normalized };

template <class Vector> std::vector<Vector> packed(const std::vector<float>& numbers) {
    std::vector<Vector> vectors(numbers.size() * sizeof(float) / sizeof(Vector));
    if (!numbers.empty()) std::memcpy(vectors.data(), numbers.data(), numbers.size() * sizeof(float));
    return vectors;
}

class Attributes {
  public:
    Attributes(const GltfFile& file, const std::map<std::string, int>& names, std::string who,
               size_t vertices)
        : file_(file), names_(names), who_(std::move(who)), vertices_(vertices) {}

    bool has(const char* name) const { return names_.contains(name); }
    std::string where(const char* name) const { return who_ + "." + name; }
    const tinygltf::Accessor& accessor(const char* name) const {
        return file_.gltf.accessors[names_.at(name)];
    }

    // Reads an attribute as floats. KHR_mesh_quantization allows integers of 8 and 16 bits in any attribute.
    std::vector<float> floats(const char* name, std::initializer_list<int> types,
                              Integers integers = Integers::None) const {
        const tinygltf::Accessor& a = accessor(name);
        check(name, types,
              a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || (file_.quantized && isShort(a)) ||
                  (integers == Integers::Normalized && a.normalized && isUnsignedShort(a)));
        return readFloats(file_.gltf, names_.at(name));
    }

    std::vector<uint32_t> integers(const char* name) const {
        check(name, {TINYGLTF_TYPE_VEC4}, isUnsignedShort(accessor(name)) && !accessor(name).normalized);
        return readIntegers(file_.gltf, names_.at(name));
    }

    // Returns the attribute's vectors; empty if the primitive does not have it.
    std::vector<glm::vec3> vectors(const char* name) const {
        return has(name) ? packed<glm::vec3>(floats(name, {TINYGLTF_TYPE_VEC3})) : std::vector<glm::vec3>();
    }

  private:
    static bool isUnsignedShort(const tinygltf::Accessor& a) { // of 8 or 16 bits
        return a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
               a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    }
    static bool isShort(const tinygltf::Accessor& a) {
        return isUnsignedShort(a) || a.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
               a.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
    }

    void check(const char* name, std::initializer_list<int> types, bool components) const {
        const tinygltf::Accessor& a = accessor(name);
        const std::string who = where(name) + ": " + element("accessors", names_.at(name));
        if (std::find(types.begin(), types.end(), a.type) == types.end() || !components)
            fault(who, " has a type that this attribute cannot have");
        if (a.count != vertices_)
            fault(who, " has ", a.count, " elements, but the primitive ", vertices_, " vertices");
    }

    const GltfFile& file_;
    const std::map<std::string, int>& names_;
    std::string who_;
    size_t vertices_;
};

void readShading(const Attributes& attributes, GltfFile& file, Primitive& primitive) {
    primitive.normals = attributes.vectors("NORMAL");
    for (glm::vec3& normal : primitive.normals) {
        if (normal == glm::vec3(0)) file.warn(attributes.where("NORMAL"), " holds normals of no length");
        normal = safeNormalize(glm::dvec3(normal), {0, 1, 0});
    }
    if (attributes.has("TANGENT") && attributes.has("NORMAL")) {
        primitive.tangents = packed<glm::vec4>(attributes.floats("TANGENT", {TINYGLTF_TYPE_VEC4}));
        for (size_t i = 0; i < primitive.tangents.size(); ++i) {
            glm::vec4& t = primitive.tangents[i];
            t = {safeNormalize(glm::dvec3(t), perpendicular(primitive.normals[i])), t.w < 0 ? -1.0f : 1.0f};
        }
    }
    constexpr const char* kSets[2] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (int set = 0; set < 2; ++set)
        if (attributes.has(kSets[set]))
            primitive.texCoords[set] =
                packed<glm::vec2>(attributes.floats(kSets[set], {TINYGLTF_TYPE_VEC2}, Integers::Normalized));
    if (attributes.has("COLOR_0")) {
        const auto numbers =
            attributes.floats("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, Integers::Normalized);
        if (attributes.accessor("COLOR_0").type == TINYGLTF_TYPE_VEC4)
            primitive.coloursLin = packed<glm::vec4>(numbers);
        else
            for (const glm::vec3& colour : packed<glm::vec3>(numbers))
                primitive.coloursLin.emplace_back(colour, 1.0f);
    }
}

// Reads the four heaviest influences of each vertex, scaled to the sum 1. A vertex without weights follows
// its first joint.
void readSkinning(const Attributes& attributes, GltfFile& file, Primitive& primitive) {
    struct Set {
        std::vector<uint32_t> joints;
        std::vector<float> weights; // joints and weights: four for each vertex
    };
    std::vector<Set> sets;
    for (const auto& [joints, weights] : {std::pair{"JOINTS_0", "WEIGHTS_0"}, {"JOINTS_1", "WEIGHTS_1"}}) {
        if (!attributes.has(joints) && !attributes.has(weights)) break;
        if (!attributes.has(weights)) fault(attributes.where(joints), " is there without ", weights);
        if (!attributes.has(joints)) fault(attributes.where(weights), " is there without ", joints);
        sets.push_back({attributes.integers(joints),
                        attributes.floats(weights, {TINYGLTF_TYPE_VEC4}, Integers::Normalized)});
    }
    if (sets.empty()) return;
    if (sets.size() > 1)
        file.warn(attributes.where("JOINTS_1"), ": the four heaviest joints of each vertex are kept");
    primitive.joints.resize(primitive.positions.size());
    primitive.weights.resize(primitive.positions.size());
    std::vector<std::pair<float, uint32_t>> influences;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        influences.clear();
        for (const Set& set : sets)
            for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
                if (set.weights[k] < 0)
                    fault(attributes.where("WEIGHTS_0"), ": vertex ", v, " has a negative weight");
                influences.emplace_back(set.weights[k], set.joints[k]);
            }
        std::stable_sort(influences.begin(), influences.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += influences[k].first;
        if (sum == 0) file.warn(attributes.where("WEIGHTS_0"), " holds vertices without any weight");
        for (int k = 0; k < 4; ++k) {
            const auto& [weight, joint] = influences[k];
            primitive.joints[v][k] = static_cast<uint16_t>(joint);
            primitive.weights[v][k] = sum > 0 ? static_cast<float>(weight / sum) : (k == 0 ? 1.0f : 0.0f);
        }
    }
}

} // namespace

Primitive readAttributes(GltfFile& file, const tinygltf::Primitive& from, const std::string& who) {
    const size_t vertices = file.gltf.accessors[from.attributes.at("POSITION")].count;
    for (size_t k = 0; k < 1 + from.targets.size(); ++k) file.vertices.spend(vertices, who);
    Primitive primitive;
    const Attributes attributes(file, from.attributes, who, vertices);
    primitive.positions = attributes.vectors("POSITION");
    readShading(attributes, file, primitive);
    readSkinning(attributes, file, primitive);
    for (size_t t = 0; t < from.targets.size(); ++t) {
        const Attributes deltas(file, from.targets[t], who + "." + element("targets", t), vertices);
        primitive.morphTargets.push_back(
            {deltas.vectors("POSITION"), deltas.vectors("NORMAL"), deltas.vectors("TANGENT")});
    }
    return primitive;
}

} // namespace shoal::scene
