// The state of one glTF file while it is being read, with its use of the limits, and the functions of the
// loader. Private to loadModel().
#pragma once

#define TINYGLTF_NO_FS // bytes reach tinygltf checked; images are read by decodeImage()
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

#include "engine/scene/Model.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shoal::scene {

template <class... Parts> std::string text(const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
}

// Throws the reason why the file is refused, which loadModel() turns into an Error: with a Result each of the
// loader's hundred checks would need a second one in its caller.
template <class... Parts> [[noreturn]] void fault(const Parts&... parts) {
    throw std::runtime_error(text(parts...));
}

// Returns a name from the file in a form that can be shown: shortened, control characters replaced.
std::string quoted(const std::string& untrusted, size_t maxLength = 60);

// Returns the name of an element, such as "accessors[3]".
inline std::string element(const std::string& array, size_t index) {
    return array + "[" + std::to_string(index) + "]";
}

// A limit of memory or elements for the whole file, and the amount used so far.
struct Budget {
    uint64_t limit = 0;
    const char* unit = "";
    uint64_t spent = 0;

    // Counts an amount; call it before memory is allocated. who: the element that needs it, for the message.
    void spend(uint64_t amount, const std::string& who) {
        if (amount > limit - spent)
            fault(who, " brings the model to more than the limit of ", limit, " ", unit);
        spent += amount;
    }
};

// Source of a set of texture coordinates: a set of the file, and KHR_texture_transform applied to it.
struct UvSource {
    int texCoord = -1; // -1: no texture uses the set
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; // radians, about the picture's upper left corner

    bool operator==(const UvSource&) const = default;
};

struct GltfFile {
    Path path;
    LoadLimits limits;
    Budget bytes{limits.maxTotalBytes, "bytes"}, vertices{limits.maxVertices, "vertices"},
        indices{limits.maxIndices, "indices"}, pixels{limits.maxImagePixels, "image pixels"},
        keyValues{limits.maxKeyValues, "key values"};
    std::set<std::string> warnings;

    tinygltf::Model gltf;     // holds the buffers' bytes, but no images
    bool quantized = false;   // KHR_mesh_quantization is used
    nlohmann::json images;    // as in the file, checked
    nlohmann::json materials; // as in the file, with their extensions, of which only core members are checked
    // Sources, by material, of the two sets in Primitive::texCoords to which TextureUse::texCoord refers.
    std::vector<std::array<UvSource, 2>> uvSources;
    // KHR_materials_variants: names of the variants, and materials by mesh, primitive and variant; -1: the
    // primitive's own material.
    std::vector<std::string> variants;
    std::vector<std::vector<std::vector<int>>> variantMaterials;

    template <class... Parts> void warn(const Parts&... parts) {
        if (warnings.size() < 100) warnings.insert(text(parts...));
    }
};

// All functions below throw what fault() throws.

// Checks a document against the specification before tinygltf reads it, because tinygltf narrows 64-bit
// numbers, skips members of the wrong type, and trusts some indices. Afterwards every member that the loader
// reads has the right type; indices of elements are in range; sizes and counts are 0 .. 2^31-1; numbers are
// finite as floats; lists have at most maxElements (accessors and bufferViews four times as many).
void checkSchema(const nlohmann::json& document, uint32_t maxElements);

// Fills file.variants and file.variantMaterials. root: the document with its extensions, unchecked.
void readVariants(const nlohmann::json& root, GltfFile& file);

// Returns the bytes of a data URI, or of a file at or below the model's own folder, to which links must lead
// too. who: the element that names the URI, for messages.
std::vector<uint8_t> readUri(GltfFile& file, const std::string& uri, const std::string& who);

// Decodes a PNG or JPEG image, the two formats of core glTF. The size in its header is checked against the
// limits first. Grey and palette images are converted to RGBA; 16-bit channels keep their upper 8 bits.
ImageRgba8 decodeImage(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who);

// Checks that every bufferView lies in its buffer, every accessor and its sparse part in their bufferViews,
// that component types exist, and that counts are at least 1.
void checkAccessors(GltfFile& file);

// Returns the number of components of one element: 1 for SCALAR ... 16 for MAT4.
size_t componentCount(const tinygltf::Accessor& accessor);

// Returns count * components numbers of any accessor, sparse or not; matrices by columns. Normalized integers
// become -1 .. 1 or 0 .. 1 (glTF 2.0 specification, 3.6.2.2), other integers keep their value. All are
// finite. The caller must have checked accessor.count against its limit.
std::vector<float> readFloats(const tinygltf::Model& gltf, int accessor);
std::vector<uint32_t> readIntegers(const tinygltf::Model& gltf, int accessor); // unsigned

// Fills model.textures and materials; images get their number.
void readMaterials(GltfFile& file, Model& model);

// Fills model.images, of all materials or of the primitives' alone. Others stay empty: they may be of any
// format, such as alternatives for extensions.
void readImages(GltfFile& file, Model& model, bool ofPrimitives);

// Fills model.nodes, order and skins. Checks that the nodes form trees, and that the joints of every skinned
// node in the scene are in the scene.
void readNodes(GltfFile& file, Model& model);

// Fills model.meshes; materials, nodes and skins must have been read. Every primitive gets normals, and
// tangents if its material has a normal map.
void readMeshes(GltfFile& file, Model& model);

// Fills model.animations; nodes and meshes must have been read. Channels without effect are left out.
void readAnimations(GltfFile& file, Model& model);

} // namespace shoal::scene
