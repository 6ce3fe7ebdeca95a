#include "engine/core/JsonBounds.h"
#include "engine/scene/Gltf.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace shoal::scene {

namespace {

// A .glb or .gltf file taken apart: views of its bytes.
struct Container {
    std::string_view json;
    std::optional<std::span<const uint8_t>> binary; // the GLB's BIN chunk
};

// glTF 2.0 specification, section 4 "GLB File Format Specification".
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
    // A parsed value costs up to some 100 bytes, an object of the loader's up to some 1000: below 1 GiB in
    // all.
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

// KHR_mesh_quantization only widens the component types of attributes.
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
        for (const std::string name : member(root, list)) {
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

// Cuts each buffer to its byteLength: it may lie in a larger file, and a GLB's chunk is padded.
void readBuffers(GltfFile& file, const Container& container) {
    const std::set<size_t> replaced = replacedBuffers(file.root, container.binary.has_value());
    for (const Json& from : member(file.root, "buffers")) {
        const size_t index = file.buffers.size();
        const std::string who = element("buffers", index);
        auto& bytes = file.buffers.emplace_back();
        const uint64_t byteLength = from["byteLength"];
        if (byteLength == 0) fault(who, ".byteLength is 0");
        if (replaced.contains(index)) continue;
        if (from.contains("uri"))
            bytes = readUri(file, from["uri"], who);
        else if (index == 0 && container.binary)
            bytes.assign(container.binary->begin(), container.binary->end());
        else
            fault(who, " has neither a uri nor a binary chunk");
        if (bytes.size() < byteLength)
            fault(who, ".byteLength is ", byteLength, ", but there are only ", bytes.size(), " bytes");
        bytes.resize(byteLength);
    }
}

// Returns nothing where the text is not base64 (RFC 4648).
std::vector<uint8_t> decodedBase64(std::string_view text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    while (text.ends_with('=')) text.remove_suffix(1);
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const size_t digit = kDigits.find(text[i]);
        if (digit == std::string_view::npos) return {};
        bits = bits << 6 | static_cast<uint32_t>(digit);
        if (i % 4 != 0) bytes.push_back(static_cast<uint8_t>(bits >> (6 - 2 * (i % 4))));
    }
    return bytes;
}

} // namespace

std::vector<uint8_t> readUri(GltfFile& file, const std::string& uri, const std::string& who) {
    if (uri.starts_with("data:")) {
        file.bytes.spend(uri.size(), who);
        constexpr std::string_view kMark = ";base64,";
        const size_t mark = uri.find(kMark);
        if (mark != std::string::npos) {
            auto bytes = decodedBase64(std::string_view(uri).substr(mark + kMark.size()));
            if (!bytes.empty()) return bytes;
        }
        fault(who, ".uri is a data URI that is empty or not base64");
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
    file.root = parseJson(container.json);
    checkSchema(file.root, file.limits.maxNodes);
    checkVersionAndExtensions(file, file.root);
    readBuffers(file, container);
    readAccessors(file);
}

} // namespace shoal::scene
