#include "engine/core/JsonBounds.h"
#include "engine/scene/Gltf.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

// The parts of a .glb or .gltf file, as views of its bytes.
struct Container {
    std::string_view json;
    std::optional<std::span<const uint8_t>> binary; // the GLB's BIN chunk
};

// Splits a file into its parts: glTF 2.0 specification, section 4 "GLB File Format Specification".
Container openContainer(std::span<const uint8_t> file) {
    constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
    constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
    const auto word = [&](size_t at) {
        uint32_t value;
        std::memcpy(&value, file.data() + at, sizeof value);
        return value;
    };
    if (file.size() < 4 || word(0) != kMagic)
        return {{reinterpret_cast<const char*>(file.data()), file.size()}, {}};
    if (file.size() < kHeaderBytes) fault("the GLB header is cut short");
    if (word(4) != 2) fault("is GLB version ", word(4), ", not 2");
    const uint32_t length = word(8);
    if (length < kHeaderBytes || length > file.size())
        fault("the GLB header says ", length, " bytes, but the file has ", file.size());
    Container container;
    size_t at = kHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        if (length - at < kChunkHeaderBytes) fault("GLB chunk ", chunk, " is cut short");
        const uint32_t bytes = word(at), type = word(at + 4);
        at += kChunkHeaderBytes;
        if (bytes > length - at) fault("GLB chunk ", chunk, " reaches past the end of the file");
        if (bytes % 4 != 0) fault("GLB chunk ", chunk, " has a length that is no multiple of 4");
        if ((type == kJsonChunk) != (chunk == 0) || (type == kBinaryChunk && chunk != 1))
            fault("GLB chunk ", chunk, " has a type that does not belong there");
        if (type == kJsonChunk) container.json = {reinterpret_cast<const char*>(file.data() + at), bytes};
        if (type == kBinaryChunk) container.binary = file.subspan(at, bytes);
        at += bytes; // Chunks of other types are to be ignored.
    }
    if (container.json.empty()) fault("the GLB holds no JSON chunk");
    return container;
}

Json parseJson(std::string_view text) {
    // A parsed value costs up to some 100 bytes, an object up to some 2000 in tinygltf: below 1 GiB in all.
    constexpr JsonBounds kBounds{.depth = 64, .values = 4'000'000, .objects = 500'000};
    if (const std::string exceeded = exceededBound(text, kBounds); !exceeded.empty())
        fault("its JSON ", exceeded);
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        fault("its JSON is broken at byte ", error.byte);
    } catch (const Json::out_of_range&) {
        fault("its JSON holds a number too large to be one");
    }
}

// Checks version and extensions. KHR_mesh_quantization only allows more component types of attributes.
void checkVersionAndExtensions(GltfFile& file, const Json& root) {
    const std::string version = root["asset"]["version"];
    if (!version.starts_with("2.")) fault("is glTF version ", quoted(version), ", not 2.0");
    if (const std::string minimum = root["asset"].value("minVersion", "2.0"); minimum != "2.0")
        fault("asks for glTF version ", quoted(minimum), ", but only 2.0 is supported");
    static const std::set<std::string> kRead = {"EXT_meshopt_compression",         "KHR_materials_clearcoat",
                                                "KHR_materials_emissive_strength", "KHR_materials_ior",
                                                "KHR_materials_specular",          "KHR_materials_unlit",
                                                "KHR_materials_variants",          "KHR_texture_transform"};
    for (const char* list : {"extensionsRequired", "extensionsUsed"})
        for (const std::string name : root.value(list, Json::array())) {
            if (name == "KHR_mesh_quantization")
                file.quantized = true;
            else if (kRead.contains(name))
                continue;
            else if (list == std::string_view("extensionsRequired"))
                fault("needs the extension ", quoted(name), ", which is not supported");
            else
                file.warn("the extension ", quoted(name), " is ignored");
        }
}

// Removes `extras` and `extensions`, which would only cost memory in tinygltf. Converts whole numbers written
// as 1.0, which JSON allows, to integers, as tinygltf expects. parseJson() limits the depth.
void tidy(Json& value) {
    if (value.is_object()) {
        value.erase("extras");
        value.erase("extensions");
    }
    for (Json& inner : value) {
        if (inner.is_structured()) {
            tidy(inner);
        } else if (inner.is_number_float()) {
            const double number = inner.get<double>();
            if (std::abs(number) < 0x1p53 && number == std::floor(number))
                inner = static_cast<int64_t>(number);
        }
    }
}

std::string percentDecoded(const std::string& uri) {
    std::string plain;
    for (size_t i = 0; i < uri.size(); ++i) {
        const char* const hex = uri.data() + i + 1;
        unsigned char byte = 0;
        if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2) {
            plain += static_cast<char>(byte);
            i += 2;
        } else {
            plain += uri[i];
        }
    }
    return plain;
}

// Returns the file of a relative URI. Links may lead anywhere below the folder, but not out of it.
Path confined(const Path& folder, const std::string& uri, const std::string& who) {
    namespace fs = std::filesystem;
    const std::string plain = percentDecoded(uri);
    const std::string name = who + ".uri (" + quoted(plain) + ")";
    if (plain.empty()) fault(who, ".uri is empty");
    if (plain.find(':') != std::string::npos) fault(name, " is no file of the model's own folder");
    if (plain.find('\0') != std::string::npos || plain.find('\\') != std::string::npos)
        fault(name, " holds characters that no file name should");
    std::error_code code;
    const Path root = fs::canonical(folder.empty() ? Path(".") : folder, code);
    if (code) fault(who, ".uri: the model's folder cannot be read");
    const Path target = fs::weakly_canonical(root / plain, code);
    if (code) fault(name, " cannot be read: ", code.message());
    if (std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end())
        fault(name, " leads out of the model's own folder");
    return target;
}

// Reads the buffers, cut to byteLength: a buffer's file may be larger, and a GLB's chunk is padded.
std::vector<tinygltf::Buffer> readBuffers(GltfFile& file, const Json& root, const Container& container) {
    std::vector<tinygltf::Buffer> buffers;
    const std::set<size_t> replaced = replacedBuffers(root, container.binary.has_value());
    for (const Json& from : root.value("buffers", Json::array())) {
        const std::string who = element("buffers", buffers.size());
        auto& bytes = buffers.emplace_back().data;
        const uint64_t byteLength = from["byteLength"];
        if (byteLength == 0) fault(who, ".byteLength is 0");
        if (replaced.contains(buffers.size() - 1)) continue;
        if (from.contains("uri"))
            bytes = readUri(file, from["uri"], who);
        else if (buffers.size() == 1 && container.binary)
            bytes.assign(container.binary->begin(), container.binary->end());
        else
            fault(who, " has neither a uri nor a binary chunk");
        if (bytes.size() < byteLength)
            fault(who, ".byteLength is ", byteLength, ", but there are only ", bytes.size(), " bytes");
        bytes.resize(byteLength);
    }
    return buffers;
}

std::vector<ImageSource> imageSources(const Json& root) {
    std::vector<ImageSource> sources;
    for (const Json& image : root.value("images", Json::array())) {
        if (image.contains("uri") == image.contains("bufferView"))
            fault(element("images", sources.size()), " has not exactly one of uri and bufferView");
        sources.push_back(
            {image.value("uri", ""), image.value("bufferView", -1), image.value("mimeType", "")});
    }
    return sources;
}

tinygltf::Model parseGltf(const Json& root) {
    const std::string json = root.dump();
    tinygltf::Model gltf;
    std::string errors, warnings;
    if (!tinygltf::TinyGLTF().LoadASCIIFromString(&gltf, &errors, &warnings, json.data(),
                                                  static_cast<unsigned>(json.size()), "")) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        while (errors.ends_with(' ') || errors.ends_with('.')) errors.pop_back();
        fault("cannot be read: ", quoted(errors, 200));
    }
    return gltf;
}

} // namespace

std::vector<uint8_t> readUri(GltfFile& file, const std::string& uri, const std::string& who) {
    if (uri.starts_with("data:")) {
        file.bytes.spend(uri.size(), who);
        std::vector<uint8_t> bytes;
        std::string mimeType;
        if (!tinygltf::DecodeDataURI(&bytes, mimeType, uri, 0, false))
            fault(who, ".uri is a data URI of an unknown type, empty or not base64");
        return bytes;
    }
    const auto bytes = readFile(confined(file.path.parent_path(), uri, who), file.limits.maxFileBytes);
    if (!bytes) fault(who, ".uri (", quoted(uri), "): ", bytes.error().reason);
    file.bytes.spend(bytes->size(), who);
    return *bytes;
}

void readDocument(GltfFile& file) {
    const auto bytes = readFile(file.path, file.limits.maxFileBytes);
    if (!bytes) throw Fault(bytes.error().reason);
    file.bytes.spend(bytes->size(), "the file");
    if (bytes->empty()) fault("is empty");
    const Container container = openContainer(*bytes);
    Json root = parseJson(container.json);
    readMaterialExtensions(root, file);
    readTextureTransforms(root, file);
    readVariants(root, file);
    keepCompression(root);
    if (root.is_structured()) tidy(root);
    checkSchema(root, file.limits.maxNodes);
    checkVersionAndExtensions(file, root);
    auto buffers = readBuffers(file, root, container);
    decompressViews(file, root, buffers);
    file.imageSources = imageSources(root);
    root.erase("buffers");
    root.erase("images");
    file.gltf = parseGltf(root);
    file.gltf.buffers = std::move(buffers);
    checkAccessors(file);
}

} // namespace shoal::scene
