#include "engine/core/JsonBounds.h"
#include "engine/core/Log.h"
#include "engine/scene/Gltf.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

// A bufferView with this extension is decoded when the file is read.
constexpr const char* kCompression = "EXT_meshopt_compression";

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

// Removes `extras` and `extensions`, which would only cost memory in tinygltf; EXT_meshopt_compression
// becomes a member of a buffer or its view itself, for checkSchema(). Converts whole numbers written as 1.0,
// which JSON allows, to integers, as tinygltf expects. parseJson() limits the depth.
void tidy(Json& value) {
    if (value.is_object()) {
        value.erase("extras");
        value.erase(kCompression);
        const Json extensions = value.value("extensions", Json());
        value.erase("extensions");
        if (extensions.contains(kCompression) && value.contains("byteLength"))
            value[kCompression] = extensions[kCompression];
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
        const bool coded =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2;
        plain += coded ? static_cast<char>(byte) : uri[i];
        if (coded) i += 2;
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
    std::set<size_t> decodedTo; // buffers whose views are decoded from other buffers
    for (const Json& view : root.value("bufferViews", Json::array()))
        if (view.contains(kCompression)) decodedTo.insert(view["buffer"].get<size_t>());
    for (const Json& from : root.value("buffers", Json::array())) {
        const size_t index = buffers.size();
        const std::string who = element("buffers", index);
        auto& bytes = buffers.emplace_back().data;
        const uint64_t byteLength = from["byteLength"];
        if (byteLength == 0) fault(who, ".byteLength is 0");
        const bool isBinary = index == 0 && container.binary, hasUri = from.contains("uri");
        const bool isFallback = from.contains(kCompression) && from[kCompression].value("fallback", false);
        if (decodedTo.contains(index) && (isFallback || !(hasUri || isBinary))) continue;
        if (hasUri)
            bytes = readUri(file, from["uri"], who);
        else if (isBinary)
            bytes.assign(container.binary->begin(), container.binary->end());
        else
            fault(who, " has neither a uri nor a binary chunk");
        if (bytes.size() < byteLength)
            fault(who, ".byteLength is ", byteLength, ", but there are only ", bytes.size(), " bytes");
        bytes.resize(byteLength);
    }
    return buffers;
}

// Returns whether the specification of EXT_meshopt_compression allows this mode and filter.
bool isKnown(const std::string& mode, const std::string& filter, size_t count, size_t stride) {
    if (mode == "TRIANGLES" || mode == "INDICES")
        return filter == "NONE" && (stride == 2 || stride == 4) && (mode == "INDICES" || count % 3 == 0);
    if (mode != "ATTRIBUTES" || stride < 1 || stride > 256 || stride % 4 != 0) return false;
    return filter == "NONE" || filter == "EXPONENTIAL" || (filter == "OCTAHEDRAL" && stride <= 8) ||
           (filter == "QUATERNION" && stride == 8);
}

// Returns the bytes of a compressed bufferView. root and view: checked by checkSchema().
std::vector<uint8_t> decompressed(GltfFile& file, const Json& view,
                                  const std::vector<tinygltf::Buffer>& buffers, const std::string& who) {
    const Json& from = view[kCompression];
    const size_t buffer = from["buffer"], offset = from.value("byteOffset", 0u), length = from["byteLength"];
    const size_t count = from["count"], stride = from["byteStride"];
    const std::string mode = from["mode"], filter = from.value("filter", "NONE");
    const auto& all = buffers[buffer].data;
    if (offset + length > all.size())
        fault(who, " reaches past the end of ", element("buffers", buffer), " (", offset + length,
              " bytes of ", all.size(), ")");
    if (count < 1) fault(who, ".count is 0");
    if (!isKnown(mode, filter, count, stride))
        fault(who, ": the mode ", quoted(mode), " cannot have ", count, " elements of ", stride,
              " bytes with the filter ", quoted(filter));
    if (view.value("byteStride", stride) != stride) fault(who, ".byteStride is not that of its bufferView");
    if (const uint64_t whole = view["byteLength"]; whole != count * stride)
        fault(who, " becomes ", count * stride, " bytes, but its bufferView has ", whole);
    file.bytes.spend(count * stride, who);
    std::vector<uint8_t> decoded(count * stride);
    void* const to = decoded.data();
    const uint8_t* const bytes = all.data() + offset;
    const int problem = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to, count, stride, bytes, length)
                        : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(to, count, stride, bytes, length)
                                              : meshopt_decodeIndexSequence(to, count, stride, bytes, length);
    if (problem != 0) fault(who, " holds a broken stream");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to, count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(to, count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(to, count, stride);
    return decoded;
}

// Makes each compressed bufferView a view of a new buffer with its decoded bytes.
void decompressViews(GltfFile& file, Json& root, std::vector<tinygltf::Buffer>& buffers) {
    if (!root.contains("bufferViews")) return;
    size_t number = 0;
    for (Json& view : root["bufferViews"]) {
        const std::string who = element("bufferViews", number++) + "." + kCompression;
        if (!view.contains(kCompression)) continue;
        std::vector<uint8_t> decoded = decompressed(file, view, buffers, who);
        view.erase(kCompression);
        view["buffer"] = buffers.size();
        view["byteOffset"] = 0;
        buffers.emplace_back().data = std::move(decoded);
    }
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

// Reads and checks the file: container, JSON, types, indices, extensions, buffers, and that every bufferView
// and accessor lies inside what it refers to.
void readDocument(GltfFile& file) {
    const auto bytes = readFile(file.path, file.limits.maxFileBytes);
    if (!bytes) fault(bytes.error().reason);
    file.bytes.spend(bytes->size(), "the file");
    if (bytes->empty()) fault("is empty");
    const Container container = openContainer(*bytes);
    Json root = parseJson(container.json);
    if (root.is_object()) file.materials = root.value("materials", Json::array());
    readVariants(root, file);
    if (root.is_structured()) tidy(root);
    checkSchema(root, file.limits.maxNodes);
    checkVersionAndExtensions(file, root);
    auto buffers = readBuffers(file, root, container);
    decompressViews(file, root, buffers);
    file.images = root.value("images", Json::array());
    for (const char* const ours : {"buffers", "images", "materials"}) root.erase(ours);
    file.gltf = parseGltf(root);
    file.gltf.buffers = std::move(buffers);
    checkAccessors(file);
}

// Checks that matrices are finite: the file's numbers are, but nested large scales may exceed floats.
void checkRestPose(const Model& model) {
    Pose pose;
    restPose(model, pose);
    for (const int node : model.order)
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(pose.modelFromNode[node][i / 4][i % 4]))
                fault(element("nodes", node), " lies infinitely far away");
}

} // namespace

std::string quoted(const std::string& untrusted, size_t maxLength) {
    std::string shown = untrusted.substr(0, maxLength);
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 32 || c == 127; }, '?');
    return untrusted.size() > maxLength ? shown + "..." : shown;
}

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

Result<Model> loadModel(const Path& path, const std::string& variant, const LoadLimits& limits) {
    GltfFile file{.path = path, .limits = limits};
    try {
        readDocument(file);
        Model model;
        readMaterials(file, model);
        readNodes(file, model);
        readMeshes(file, model);
        if (!variant.empty() && !applyVariant(model, variant)) fault("has no variant named ", variant);
        readImages(file, model, !variant.empty());
        readAnimations(file, model);
        checkRestPose(model);
        for (const std::string& warning : file.warnings) log::warn("{}: {}", path.string(), warning);
        return model;
    } catch (const std::bad_alloc&) {
        return Error{path.string(), "needs more memory than there is"};
    } catch (const std::exception& problem) {
        return Error{path.string(), problem.what()};
    }
}

} // namespace shoal::scene
