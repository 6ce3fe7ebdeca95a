// One glTF file while it is being read: its checked document, its bytes, and how much of the limits it has
// used. Private to loadModel().
#pragma once

#include "engine/scene/LoadModel.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shoal::scene {

using Json = nlohmann::json;

// A fault in the file. It is thrown up to loadModel(), which turns it into an Error: the loader has some
// hundred checks, and each would otherwise be written twice. It never leaves the loader.
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

// A name from the file, fit to be shown: cut short, control characters replaced.
std::string quoted(const std::string& untrusted, size_t maxLength = 60);

// "accessors[3]"
inline std::string element(const std::string& array, size_t index) {
    return array + "[" + std::to_string(index) + "]";
}

// An amount of which the whole file may take no more than a limit.
struct Budget {
    uint64_t limit = 0;
    const char* unit = "";
    uint64_t spent = 0;

    // Call it before memory is taken. who: the element that takes it.
    void spend(uint64_t amount, const std::string& who) {
        if (amount > limit - spent)
            fault(who, " brings the model to more than the limit of ", limit, " ", unit);
        spent += amount;
    }
};

enum ComponentType { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

struct BufferView {
    size_t buffer = 0, byteOffset = 0, byteLength = 0, byteStride = 0; // stride 0: elements without gaps
};

struct Accessor {
    std::string type;      // "SCALAR" to "MAT4"
    size_t components = 1; // of one element
    int componentType = kFloat;
    bool normalized = false;
    size_t count = 0, byteOffset = 0;
    int bufferView = -1;          // -1: all zeros
    const Json* sparse = nullptr; // null: none
};

// KHR_texture_transform of one use of a texture.
struct TextureTransform {
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; // radians, about the picture's upper left corner

    bool operator==(const TextureTransform&) const = default;
};

// How a set of texture coordinates is made: a set of the file's, transformed.
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

    Json root; // as checkSchema() has found it
    std::vector<std::vector<uint8_t>> buffers;
    std::vector<BufferView> bufferViews;
    std::vector<Accessor> accessors;
    bool quantized = false; // KHR_mesh_quantization is used
    // By material: how its primitives' two sets of texture coordinates, by TextureUse::texCoord, are made.
    std::vector<std::array<UvSource, 2>> uvSources;

    template <class... Parts> void warn(const Parts&... parts) {
        if (warnings.size() < 100) warnings.insert(text(parts...));
    }
    std::span<const uint8_t> bytesOf(const BufferView& view) const {
        return std::span(buffers[view.buffer]).subspan(view.byteOffset, view.byteLength);
    }
};

// Member of a checked document; an empty object where it is absent.
inline const Json& member(const Json& object, const char* name) {
    static const Json kEmpty = Json::object();
    const auto found = object.find(name);
    return found == object.end() ? kEmpty : *found;
}
inline const Json& extension(const Json& object, const char* name) {
    return member(member(object, "extensions"), name);
}

// All of these throw Fault.

// Reads and checks the file: container, JSON, types, indices, extensions, buffers, and that every bufferView
// and accessor lies inside what it refers to. The functions below rely on it.
void readDocument(GltfFile& file);

// Checks a document against the specification. Then every member that the loader reads has the right type;
// every number that names another element is the index of one; sizes and counts are 0 .. 2^31-1; numbers are
// finite as floats; the lists are within maxElements (accessors and bufferViews within four times that).
void checkSchema(const Json& document, uint32_t maxElements);

// EXT_meshopt_compression. Buffers whose bytes are not needed, because their views are decoded from others.
// hasBinary: the file is a GLB with a BIN chunk, buffer 0's.
std::set<size_t> replacedBuffers(const Json& root, bool hasBinary);
// Decodes a compressed view to a buffer of its own.
BufferView decompressed(GltfFile& file, const Json& view, const std::string& who);

// Returns the bytes of a URI: a data URI, or a file at or below the model's own folder, wherever links lead.
// who: the element that names the URI, for messages.
std::vector<uint8_t> readUri(GltfFile& file, const std::string& uri, const std::string& who);

// Decodes PNG and JPEG, the two formats of core glTF. Size is read from the header and held against the
// limits before anything is decoded. Grey and palette images are spread to RGBA; 16-bit ones keep their upper
// 8 bits.
ImageRgba8 decodeImage(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who);

// Fills file.bufferViews and accessors: every view lies in its buffer, every accessor and its sparse part in
// their views, component types exist, counts are at least 1. file.buffers must be there.
void readAccessors(GltfFile& file);

// Returns count * components numbers of any component type, stride, normalization, sparse or not; matrices by
// columns. Normalized integers become -1 .. 1 or 0 .. 1 (glTF 2.0 specification, 3.6.2.2), other integers
// keep their value. All are finite. Callers have held the accessor's count against their limit.
std::vector<float> readFloats(const GltfFile& file, size_t accessor);
std::vector<uint32_t> readIntegers(const GltfFile& file, size_t accessor); // of unsigned ones

// Fills model.textures, materials and those of images that a material shows; the others stay empty.
void readMaterials(GltfFile& file, Model& model);

// Fills model.nodes, order and skins. The nodes form trees; every skinned node in the scene has its joints
// there.
void readNodes(GltfFile& file, Model& model);

// Fills model.variants and meshes; materials, nodes and skins must be there. Every primitive gets normals,
// and tangents if its material has a normal map.
void readMeshes(GltfFile& file, Model& model);

// Returns one primitive's vertex attributes and morph targets, as they stand in the file, with their types
// checked; from must have the attribute POSITION. Normals and tangents get length 1, weights the sum 1 (the
// four heaviest, where there are eight). who: "meshes[0].primitives[1]".
Primitive readAttributes(GltfFile& file, const Json& from, const std::string& who);

// Fills model.animations; nodes and meshes must be there. Channels that can move nothing are left out.
void readAnimations(GltfFile& file, Model& model);

} // namespace shoal::scene
