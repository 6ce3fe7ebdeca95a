// One glTF file while it is being read: what it holds, what has been spent of the limits, and the parts of
// the loader. Private to loadModel().
#pragma once

#define TINYGLTF_NO_FS // bytes reach tinygltf checked; images are read by decodeImage()
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

#include "engine/scene/LoadModel.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shoal::scene {

// A fault in the file. It travels as an exception to loadModel, which turns it into an Error: the loader is
// some hundred checks deep, and each would otherwise be written twice. It never leaves the loader.
class Fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <class... Parts> std::string text(const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
}

template <class... Parts> [[noreturn]] void fault(const Parts&... parts) { throw Fault(text(parts...)); }

// A name out of the file, fit to be shown: cut short, control characters replaced.
std::string quoted(const std::string& untrusted, size_t maxLength = 60);

// "accessors[3]"
template <std::integral Index> std::string element(const std::string& array, Index index) {
    return array + "[" + std::to_string(index) + "]";
}

// How much of something all of the file may take.
struct Budget {
    uint64_t limit = 0;
    const char* unit = "";
    uint64_t spent = 0;

    // Before memory is taken. who: the element that takes it.
    void spend(uint64_t amount, const std::string& who) {
        if (amount > limit - spent)
            fault(who, " brings the model to more than the limit of ", limit, " ", unit);
        spent += amount;
    }
};

struct ImageSource { // either
    std::string uri;
    int bufferView = -1;
    std::string mimeType;
};

// KHR_texture_transform of one use of a texture.
struct TextureTransform {
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; // radians, about the picture's upper left corner
    int texCoord = -1;  // instead of the texture's own; -1: that

    bool operator==(const TextureTransform&) const = default;
};

struct TextureReference {
    int index = -1; // -1: none
    int texCoord = 0;
};

// Of one material, as stated.
struct MaterialExtensions {
    double emissiveStrength = 1; // KHR_materials_emissive_strength
    bool unlit = false;          // KHR_materials_unlit
    double ior = 1.5;            // KHR_materials_ior
    // KHR_materials_specular
    double specularFactor = 1;
    std::array<double, 3> specularColour = {1, 1, 1};
    TextureReference specular, specularColourMap;
    double clearcoatFactor = 0, clearcoatRoughness = 0; // KHR_materials_clearcoat
    TextureReference coat, coatRoughness;
    bool clearcoatNormals = false;
};

// What a set of texture coordinates is made of: a set of the file's, transformed.
struct UvSource {
    int texCoord = -1; // -1: nothing asks for the set
    TextureTransform transform;

    bool operator==(const UvSource&) const = default;
};

struct GltfFile {
    Path path;
    LoadLimits limits;
    Budget bytes{limits.maxTotalBytes, "bytes"}, vertices{limits.maxVertices, "vertices"},
        indices{limits.maxIndices, "indices"}, pixels{limits.maxImagePixels, "image pixels"},
        keyValues{limits.maxKeyValues, "key values"};
    std::set<std::string> warnings;

    tinygltf::Model gltf; // with its buffers' bytes; images are empty: see imageSources
    std::vector<ImageSource> imageSources;
    bool quantized = false;                             // KHR_mesh_quantization is used
    std::vector<MaterialExtensions> materialExtensions; // by material
    // By material and use: base colour, metallic-roughness, normal, occlusion, emissive
    std::vector<std::array<TextureTransform, 9>> textureTransforms;
    // By material: what the two sets that TextureUse::texCoord tells apart are made of, for its primitives
    std::vector<std::array<UvSource, 2>> uvSources;
    // KHR_materials_variants: its names, and materials by mesh, primitive and variant; -1: the primitive's
    // own.
    std::vector<std::string> variants;
    std::vector<std::vector<std::vector<int>>> variantMaterials;

    template <class... Parts> void warn(const Parts&... parts) {
        if (warnings.size() < 100) warnings.insert(text(parts...));
    }
};

// All of these throw Fault.

// Reads and checks the file: container, JSON, types, indices, extensions, buffers, and that every bufferView
// and accessor lies inside what it refers to. The functions below rely on it.
void readDocument(GltfFile& file);

// Holds a document against the specification before tinygltf sees it, which narrows 64-bit numbers, skips
// what has the wrong type, and trusts some indices. Every member that the loader reads has the right type;
// every number that names another element is the index of one; sizes and counts are 0 .. 2^31-1; numbers are
// finite as floats; the lists are within maxElements (accessors and bufferViews within four times that).
void checkSchema(const nlohmann::json& document, uint32_t maxElements);

// EXT_meshopt_compression. root: the document with its extensions, unchecked: what buffers and their views
// say of it becomes members of theirs, of the extension's name, for checkSchema().
void keepCompression(nlohmann::json& root);
// root: checked. Buffers of which no bytes are needed: their views are decoded from others'. hasBinary: the
// file is a GLB with a BIN chunk, buffer 0's.
std::set<size_t> replacedBuffers(const nlohmann::json& root, bool hasBinary);
// root: checked. Each compressed view becomes one of a new buffer that holds its decoded bytes.
void decompressViews(GltfFile& file, nlohmann::json& root, std::vector<tinygltf::Buffer>& buffers);

// root: the document with its extensions, unchecked. Fills file.materialExtensions.
void readMaterialExtensions(const nlohmann::json& root, GltfFile& file);
// Likewise. Fills file.textureTransforms.
void readTextureTransforms(const nlohmann::json& root, GltfFile& file);
// Likewise. Fills file.variants and file.variantMaterials.
void readVariants(const nlohmann::json& root, GltfFile& file);

// The bytes behind a URI: a data URI, or a file at or below the model's own folder, wherever links lead.
// who: the element that names the URI, for messages.
std::vector<uint8_t> readUri(GltfFile& file, const std::string& uri, const std::string& who);

// PNG and JPEG, the two formats of core glTF. Size is read from the header and held against the limits before
// anything is decoded. Grey and palette images are spread to RGBA; 16-bit ones keep their upper 8 bits.
ImageRgba8 decodeImage(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who);

// Every bufferView lies in its buffer, every accessor and its sparse part in their bufferViews, component
// types exist, counts are at least 1.
void checkAccessors(GltfFile& file);

// Components of one element: 1 for SCALAR ... 16 for MAT4.
size_t componentCount(const tinygltf::Accessor& accessor);

// count * components numbers of any component type, stride, normalization, sparse or not; matrices by
// columns. Normalized integers become -1 .. 1 or 0 .. 1 (glTF 2.0 specification, 3.6.2.2), other integers
// keep their value. All finite. Callers have held accessor.count against their limit.
std::vector<float> readFloats(const tinygltf::Model& gltf, int accessor);
std::vector<uint32_t> readIntegers(const tinygltf::Model& gltf, int accessor); // of unsigned ones

// Fills model.textures, materials and those of images that a material shows; the others stay empty.
void readMaterials(GltfFile& file, Model& model);

// Fills model.nodes, order and skins. The nodes form trees; every skinned node in the scene has its joints
// there.
void readNodes(GltfFile& file, Model& model);

// Fills model.meshes; materials, nodes and skins must be there. Every primitive gets normals, and tangents if
// its material has a normal map.
void readMeshes(GltfFile& file, Model& model);

// One primitive's vertex attributes and morph targets, as they stand in the file, with their types checked;
// from.attributes must name POSITION. Normals and tangents of length 1, weights of sum 1 (the four heaviest,
// where there are eight). who: "meshes[0].primitives[1]".
Primitive readAttributes(GltfFile& file, const tinygltf::Primitive& from, const std::string& who);

// Fills model.animations; nodes and meshes must be there. Channels that can move nothing are left out.
void readAnimations(GltfFile& file, Model& model);

} // namespace shoal::scene
