#include "engine/scene/Gltf.h"
#include "engine/scene/Vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace shoal::scene {

namespace {

// Vertex attributes of a primitive or of one of its morph targets.
struct Attributes {
    const GltfFile& file;
    const std::map<std::string, int>& accessors; // by attribute
    std::string who;
    size_t vertices;

    bool has(const char* name) const { return accessors.contains(name); }
    std::string where(const char* name) const { return who + "." + name; }
    const tinygltf::Accessor& accessor(const char* name) const {
        return file.gltf.accessors[accessors.at(name)];
    }

    // Returns the attribute's vectors; empty if the primitive does not have it. mayBeNormalized: the
    // attribute may also hold unsigned integers, normalised to 0 .. 1. KHR_mesh_quantization allows integers
    // of 8 and 16 bits in any attribute.
    template <class Vector>
    std::vector<Vector> vectors(const char* name, bool mayBeNormalized = false) const {
        if (!has(name)) return {};
        const tinygltf::Accessor& a = accessor(name);
        static_assert(TINYGLTF_TYPE_VEC2 == 2 && TINYGLTF_TYPE_VEC3 == 3 && TINYGLTF_TYPE_VEC4 == 4);
        check(name, Vector::length(),
              a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || (file.quantized && isShort(a)) ||
                  (mayBeNormalized && a.normalized && isUnsignedShort(a)));
        const std::vector<float> numbers = readFloats(file.gltf, accessors.at(name));
        std::vector<Vector> vectors(vertices);
        std::memcpy(vectors.data(), numbers.data(), numbers.size() * sizeof(float));
        return vectors;
    }

    // Returns four numbers for each vertex.
    std::vector<uint32_t> integers(const char* name) const {
        check(name, TINYGLTF_TYPE_VEC4, isUnsignedShort(accessor(name)) && !accessor(name).normalized);
        return readIntegers(file.gltf, accessors.at(name));
    }

    static bool isUnsignedShort(const tinygltf::Accessor& a) { // of 8 or 16 bits
        return a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
               a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    }
    static bool isShort(const tinygltf::Accessor& a) {
        return isUnsignedShort(a) || a.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
               a.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
    }

    void check(const char* name, int type, bool components) const {
        const tinygltf::Accessor& a = accessor(name);
        const std::string held = where(name) + ": " + element("accessors", accessors.at(name));
        if (a.type != type || !components) fault(held, " has a type that this attribute cannot have");
        if (a.count != vertices)
            fault(held, " has ", a.count, " elements, but the primitive ", vertices, " vertices");
    }
};

void readShading(const Attributes& attributes, GltfFile& file, Primitive& primitive) {
    primitive.normals = attributes.vectors<glm::vec3>("NORMAL");
    for (glm::vec3& normal : primitive.normals) {
        if (normal == glm::vec3(0)) file.warn(attributes.where("NORMAL"), " holds normals of no length");
        normal = safeNormalize(glm::dvec3(normal), {0, 1, 0});
    }
    if (attributes.has("NORMAL")) primitive.tangents = attributes.vectors<glm::vec4>("TANGENT");
    for (size_t i = 0; i < primitive.tangents.size(); ++i) {
        glm::vec4& t = primitive.tangents[i];
        t = {safeNormalize(glm::dvec3(t), perpendicular(primitive.normals[i])), t.w < 0 ? -1.0f : 1.0f};
    }
    primitive.texCoords[0] = attributes.vectors<glm::vec2>("TEXCOORD_0", true);
    primitive.texCoords[1] = attributes.vectors<glm::vec2>("TEXCOORD_1", true);
    if (attributes.has("COLOR_0") && attributes.accessor("COLOR_0").type == TINYGLTF_TYPE_VEC3)
        for (const glm::vec3& colour : attributes.vectors<glm::vec3>("COLOR_0", true))
            primitive.coloursLin.emplace_back(colour, 1.0f);
    else
        primitive.coloursLin = attributes.vectors<glm::vec4>("COLOR_0", true);
}

// Reads the four heaviest influences of each vertex, scaled to the sum 1. A vertex without weights follows
// its first joint.
void readSkinning(const Attributes& attributes, GltfFile& file, Primitive& primitive) {
    struct Set {
        std::vector<uint32_t> joints; // four for each vertex
        std::vector<glm::vec4> weights;
    };
    std::vector<Set> sets;
    for (const auto& [joints, weights] : {std::pair{"JOINTS_0", "WEIGHTS_0"}, {"JOINTS_1", "WEIGHTS_1"}}) {
        if (!attributes.has(joints) && !attributes.has(weights)) break;
        if (!attributes.has(weights)) fault(attributes.where(joints), " is there without ", weights);
        if (!attributes.has(joints)) fault(attributes.where(weights), " is there without ", joints);
        sets.push_back({attributes.integers(joints), attributes.vectors<glm::vec4>(weights, true)});
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
            for (int k = 0; k < 4; ++k) {
                if (set.weights[v][k] < 0)
                    fault(attributes.where("WEIGHTS_0"), ": vertex ", v, " has a negative weight");
                influences.emplace_back(set.weights[v][k], set.joints[4 * v + k]);
            }
        std::ranges::stable_sort(influences, std::greater(), [](const auto& each) { return each.first; });
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

// Returns one primitive's vertex attributes and morph targets, and checks their types; from.attributes must
// contain POSITION. Normals and tangents get length 1, weights the sum 1 (of eight the four largest stay).
Primitive readAttributes(GltfFile& file, const tinygltf::Primitive& from, const std::string& who) {
    const size_t vertices = file.gltf.accessors[from.attributes.at("POSITION")].count;
    for (size_t k = 0; k < 1 + from.targets.size(); ++k) file.vertices.spend(vertices, who);
    Primitive primitive;
    const Attributes attributes{file, from.attributes, who, vertices};
    primitive.positions = attributes.vectors<glm::vec3>("POSITION");
    readShading(attributes, file, primitive);
    readSkinning(attributes, file, primitive);
    for (size_t t = 0; t < from.targets.size(); ++t) {
        const Attributes deltas{file, from.targets[t], who + "." + element("targets", t), vertices};
        primitive.morphTargets.push_back(
            {deltas.vectors<glm::vec3>("POSITION"), deltas.vectors<glm::vec3>("NORMAL")});
    }
    return primitive;
}

// Returns the vertex indices in drawing order, for the primitive's mode.
std::vector<uint32_t> readIndices(GltfFile& file, const tinygltf::Primitive& from, size_t vertices,
                                  const std::string& who) {
    const uint64_t perIndex = from.mode == TINYGLTF_MODE_TRIANGLES ? 1 : 3; // strips become triangle lists
    if (from.indices < 0) {
        file.indices.spend(vertices * perIndex, who);
        std::vector<uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    const tinygltf::Accessor& accessor = file.gltf.accessors[from.indices];
    const std::string name = who + ".indices: " + element("accessors", from.indices);
    const int type = accessor.componentType;
    const bool whole = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !whole || accessor.normalized)
        fault(name, " does not hold single unsigned integers");
    file.indices.spend(accessor.count * perIndex, who);
    std::vector<uint32_t> indices = readIntegers(file.gltf, from.indices);
    const auto wrong = std::ranges::find_if(indices, [&](uint32_t index) { return index >= vertices; });
    if (wrong != indices.end())
        fault(name, ": number ", wrong - indices.begin(), " is ", *wrong, ", but there are ", vertices,
              " vertices");
    return indices;
}

// Converts a strip or fan to triangles (glTF 2.0, 3.7.2.1), without the degenerate ones that join strips.
std::vector<uint32_t> triangleList(const std::vector<uint32_t>& drawn, int mode) {
    std::vector<uint32_t> list;
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) list.insert(list.end(), {a, b, c});
    };
    for (size_t i = 0; i + 2 < drawn.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            add(drawn[i], drawn[i + 1 + i % 2], drawn[i + 2 - i % 2]);
        else
            add(drawn[i + 1], drawn[i + 2], drawn[0]);
    }
    return list;
}

void addTangents(GltfFile& file, const Material& material, Primitive& primitive, const std::string& who) {
    if (material.normal.texture >= 0 && !primitive.tangents.empty()) return;
    primitive.tangents.clear();
    if (material.normal.texture < 0) return;
    const int set = material.normal.texCoord;
    if (primitive.texCoords[set].empty()) {
        file.warn(who, " has a normal map, but no TEXCOORD_", set);
        for (const glm::vec3& normal : primitive.normals)
            primitive.tangents.emplace_back(perpendicular(normal), 1);
        return;
    }
    TangentSplit split = makeTangents(primitive, set);
    const size_t before = primitive.positions.size(), after = split.source.size();
    if (after > before) file.vertices.spend((after - before) * (1 + primitive.morphTargets.size()), who);
    takeVertices(primitive, split.source);
    primitive.tangents = std::move(split.tangents);
    primitive.indices = std::move(split.indices);
}

bool movesAny(const std::array<UvSource, 2>& sets) {
    for (int k = 0; k < 2; ++k)
        if (const UvSource& set = sets[k]; set.texCoord >= 0 && set != UvSource{k}) return true;
    return false;
}

// Applies the texture transforms of the material's two sets (KHR_texture_transform).
void transformUvs(const std::array<UvSource, 2>& sets, Primitive& primitive) {
    if (!movesAny(sets)) return;
    const std::vector<glm::vec2> given[2] = {primitive.texCoords[0], primitive.texCoords[1]};
    for (size_t k = 0; k < 2; ++k) {
        if (sets[k].texCoord < 0) continue;
        const UvSource& by = sets[k];
        const float c = std::cos(by.rotation), s = std::sin(by.rotation);
        primitive.texCoords[k] = given[sets[k].texCoord];
        for (glm::vec2& uv : primitive.texCoords[k]) {
            const glm::vec2 scaled = by.scale * uv;
            uv = by.offset + glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
        }
    }
}

std::optional<Primitive> readPrimitive(GltfFile& file, const Model& model, const tinygltf::Primitive& from,
                                       const std::string& who) {
    if (from.mode > TINYGLTF_MODE_TRIANGLE_FAN) fault(who, ".mode is ", from.mode, ", none of glTF");
    const auto leftOut = [&](const char* reason) {
        file.warn(who, reason);
        return std::nullopt;
    };
    if (from.mode < TINYGLTF_MODE_TRIANGLES) return leftOut(" is points or lines, which are not drawn");
    if (!from.attributes.contains("POSITION")) return leftOut(" has no positions and is not drawn");
    Primitive primitive = readAttributes(file, from, who);
    primitive.material = from.material;
    primitive.indices = readIndices(file, from, primitive.positions.size(), who);
    if (from.mode != TINYGLTF_MODE_TRIANGLES) primitive.indices = triangleList(primitive.indices, from.mode);
    if (primitive.indices.size() % 3 != 0) {
        file.warn(who, " ends in the middle of a triangle");
        primitive.indices.resize(primitive.indices.size() / 3 * 3);
    }
    if (primitive.indices.empty()) return leftOut(" has no triangles");
    if (primitive.normals.empty()) {
        file.vertices.spend(primitive.indices.size() * (1 + primitive.morphTargets.size()), who);
        makeFlatNormals(primitive);
    }
    if (primitive.material >= 0) transformUvs(file.uvSources[primitive.material], primitive);
    addTangents(file, model.materialOf(primitive), primitive, who);
    return primitive;
}

Mesh readMesh(GltfFile& file, const Model& model, const tinygltf::Mesh& from, const std::string& who) {
    Mesh mesh;
    if (from.primitives.empty()) fault(who, ".primitives is empty");
    const size_t targets = from.primitives[0].targets.size();
    for (size_t p = 0; p < from.primitives.size(); ++p) {
        const std::string name = who + "." + element("primitives", p);
        if (from.primitives[p].targets.size() != targets)
            fault(name, " has ", from.primitives[p].targets.size(), " morph targets, but the first ",
                  targets);
        auto primitive = readPrimitive(file, model, from.primitives[p], name);
        if (!primitive) continue;
        if (!file.variants.empty())
            primitive->variantMaterials = file.variantMaterials[model.meshes.size()][p];
        for (const int other : primitive->variantMaterials) {
            if (other < 0 || primitive->material < 0) continue;
            const auto &sets = file.uvSources[primitive->material], &others = file.uvSources[other];
            if (sets != others && (movesAny(sets) || movesAny(others)))
                file.warn(name,
                          " has a variant whose textures are transformed otherwise; they lie as the first's");
        }
        mesh.primitives.push_back(std::move(*primitive));
    }
    if (!from.weights.empty() && from.weights.size() != targets)
        fault(who, " has ", from.weights.size(), " weights for ", targets, " morph targets");
    for (const double weight : from.weights) mesh.morphWeights.push_back(static_cast<float>(weight));
    mesh.morphWeights.resize(targets, 0);
    return mesh;
}

// Checks that joints are in range of every skin that the mesh is drawn with; without one they are removed.
void checkJoints(Model& model) {
    constexpr size_t kNoSkin = std::numeric_limits<size_t>::max();
    std::vector<size_t> jointCount(model.meshes.size(), kNoSkin);
    for (const Node& node : model.nodes)
        if (node.mesh >= 0 && node.skin >= 0) {
            size_t& count = jointCount[node.mesh];
            count = std::min(count, model.skins[node.skin].joints.size());
        }
    for (size_t m = 0; m < model.meshes.size(); ++m)
        for (Primitive& primitive : model.meshes[m].primitives) {
            if (jointCount[m] == kNoSkin) primitive.joints.clear(), primitive.weights.clear();
            for (size_t v = 0; v < primitive.joints.size(); ++v)
                for (int k = 0; k < 4; ++k) {
                    if (primitive.joints[v][k] < jointCount[m]) continue;
                    if (primitive.weights[v][k] > 0)
                        fault("meshes[", m, "].primitives: a vertex hangs on joint ", primitive.joints[v][k],
                              " of a skin with ", jointCount[m], " joints");
                    primitive.joints[v][k] = 0;
                }
        }
}

} // namespace

void readMeshes(GltfFile& file, Model& model) {
    model.variants = file.variants;
    for (const tinygltf::Mesh& mesh : file.gltf.meshes)
        model.meshes.push_back(readMesh(file, model, mesh, element("meshes", model.meshes.size())));
    checkJoints(model);
}

} // namespace shoal::scene
