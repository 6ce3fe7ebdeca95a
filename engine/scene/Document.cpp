#include "engine/scene/Document.h"

#include "engine/scene/Accessors.h"
#include "engine/scene/Container.h"
#include "engine/scene/Loading.h"
#include "engine/scene/Resources.h"
#include "engine/scene/Schema.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;
using Bytes = std::vector<uint8_t>;

Json parseJson(std::string_view text) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        fault("its JSON is broken at byte ", error.byte);
    } catch (const Json::out_of_range&) {
        fault("its JSON holds a number too large to be one");
    }
}

void checkVersion(const Json& asset) {
    const std::string version = asset["version"];
    if (!version.starts_with("2.")) fault("is glTF version ", quoted(version), ", not 2.0");
    if (const std::string minimum = asset.value("minVersion", "2.0"); minimum != "2.0")
        fault("asks for glTF version ", quoted(minimum), ", but only 2.0 is supported");
}

// KHR_mesh_quantization only widens the component types of attributes.
void checkExtensions(Loading& loading, const Json& root) {
    static const std::set<std::string> kSupported = {"KHR_mesh_quantization", "KHR_materials_variants"};
    for (const std::string name : root.value("extensionsRequired", Json::array()))
        if (!kSupported.contains(name))
            fault("needs the extension ", quoted(name), ", which is not supported");
    for (const std::string name : root.value("extensionsUsed", Json::array()))
        if (!kSupported.contains(name)) loading.warn("the extension ", quoted(name), " is ignored");
}

bool uses(const Json& root, const std::string& extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        for (const std::string name : root.value(list, Json::array()))
            if (name == extension) return true;
    return false;
}

// Drops members that the loader does not read: they would cost memory in tinygltf, whatever they hold.
// Makes whole numbers written as 1.0, which JSON allows, into integers, as tinygltf expects. Depth is bounded
// by checkJsonSize.
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

// Cut to byteLength: a buffer may lie in a larger file, and a GLB's chunk is padded.
std::vector<Bytes> readBuffers(Loading& loading, const Json& root, const Container& container) {
    std::vector<Bytes> buffers;
    for (const Json& buffer : root.value("buffers", Json::array())) {
        const std::string who = element("buffers", static_cast<int64_t>(buffers.size()));
        const uint64_t byteLength = buffer["byteLength"];
        if (byteLength == 0) fault(who, ".byteLength is 0");
        Bytes bytes;
        if (buffer.contains("uri")) {
            bytes = readUri(loading, buffer["uri"], who);
        } else if (buffers.empty() && container.binary) {
            bytes.assign(container.binary->begin(), container.binary->end());
        } else {
            fault(who, " has neither a uri nor a binary chunk");
        }
        if (bytes.size() < byteLength)
            fault(who, ".byteLength is ", byteLength, ", but there are only ", bytes.size(), " bytes");
        bytes.resize(byteLength);
        buffers.push_back(std::move(bytes));
    }
    return buffers;
}

std::vector<ImageSource> takeImageSources(Json& root) {
    std::vector<ImageSource> sources;
    if (!root.contains("images")) return sources;
    for (Json& image : root["images"]) {
        const std::string who = element("images", static_cast<int64_t>(sources.size()));
        if (image.contains("uri") == image.contains("bufferView"))
            fault(who, image.contains("uri") ? " has both a uri and a bufferView"
                                             : " has neither a uri nor a bufferView");
        ImageSource& source = sources.emplace_back();
        source.uri = image.value("uri", "");
        source.bufferView = image.value("bufferView", -1);
        source.mimeType = image.value("mimeType", "");
        image = Json{{"uri", "0"}};
    }
    return sources;
}

// tinygltf asks for each buffer by the name that parse() has given it: its number.
bool numberExists(const std::string&, void*) { return true; }
std::string numberItself(const std::string& name, void*) { return name; }
bool takeBuffer(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
    auto& buffers = *static_cast<std::vector<Bytes>*>(user);
    *out = std::move(buffers[std::stoul(name.substr(name.find_last_of('/') + 1))]);
    return true;
}

tinygltf::Model parse(Json& root, std::vector<Bytes>& buffers) {
    for (size_t i = 0; i < buffers.size(); ++i) root["buffers"][i]["uri"] = std::to_string(i);
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks({numberExists, numberItself, takeBuffer, nullptr, &buffers});
    const std::string json = root.dump();
    tinygltf::Model model;
    std::string errors, warnings;
    const bool read = reader.LoadASCIIFromString(&model, &errors, &warnings, json.data(),
                                                 static_cast<unsigned>(json.size()), "");
    if (!read) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        while (errors.ends_with(' ') || errors.ends_with('.')) errors.pop_back();
        fault("cannot be read: ", quoted(errors, 200));
    }
    return model;
}

} // namespace

Document readDocument(Loading& loading) {
    auto file = readFile(loading.file, loading.limits.maxFileBytes);
    if (!file) throw Fault(file.error().reason);
    Loading::spend(loading.bytes, file->size(), loading.limits.maxTotalBytes, "the file", "bytes");
    if (file->empty()) fault("is empty");
    const Container container = openContainer(*file);
    checkJsonSize(container.json);
    Json root = parseJson(container.json);
    Variants variants = readVariants(root);
    if (root.is_structured()) tidy(root);
    checkSchema(root, loading.limits.maxNodes);
    checkVersion(root["asset"]);
    checkExtensions(loading, root);

    Document document;
    document.variants = std::move(variants);
    document.quantized = uses(root, "KHR_mesh_quantization");
    std::vector<Bytes> buffers = readBuffers(loading, root, container);
    document.imageSources = takeImageSources(root);
    document.gltf = parse(root, buffers);
    checkAccessors(loading, document.gltf);
    return document;
}

} // namespace shoal::scene
