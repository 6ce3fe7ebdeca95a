#include "engine/scene/Gltf.h"

#include <algorithm>
#include <charconv>

namespace shoal::scene {

namespace {

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

// Where a relative URI leads. Links may lead anywhere below the folder, but not out of it.
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

} // namespace shoal::scene
