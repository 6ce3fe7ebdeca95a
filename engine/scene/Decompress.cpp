// EXT_meshopt_compression: bufferViews whose bytes are decoded when the file is read.
#include "engine/scene/Gltf.h"

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

constexpr const char* kName = "EXT_meshopt_compression";

struct Stream {
    std::span<const uint8_t> bytes;
    size_t count, stride; // of what it becomes
    std::string mode, filter;
};

// What the extension's specification asks of each mode and filter, before anything is decoded.
void checkStream(const Stream& stream, const std::string& who) {
    const auto [bytes, count, stride, mode, filter] = stream;
    const bool attributes = mode == "ATTRIBUTES";
    if (!attributes && mode != "TRIANGLES" && mode != "INDICES")
        fault(who, ".mode is ", quoted(mode), ", no mode of the extension");
    if (count < 1) fault(who, ".count is 0");
    if (attributes ? stride < 1 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4)
        fault(who, ".byteStride is ", stride, ", which ", mode, " cannot have");
    if (mode == "TRIANGLES" && count % 3 != 0) fault(who, ".count is ", count, ", no multiple of 3");
    if (filter == "NONE") return;
    if (filter != "OCTAHEDRAL" && filter != "QUATERNION" && filter != "EXPONENTIAL")
        fault(who, ".filter is ", quoted(filter), ", no filter of the extension");
    if (!attributes) fault(who, ".filter is ", filter, ", which ", mode, " cannot have");
    if ((filter == "OCTAHEDRAL" && stride != 4 && stride != 8) || (filter == "QUATERNION" && stride != 8))
        fault(who, ".byteStride is ", stride, ", which the filter ", filter, " cannot have");
}

// The stream of a view, which lies in its buffer and becomes as many bytes as the view has.
Stream streamOf(const Json& view, const std::vector<tinygltf::Buffer>& buffers, const std::string& who) {
    const Json& from = view[kName];
    const size_t buffer = from["buffer"], offset = from.value("byteOffset", 0u), length = from["byteLength"];
    const auto& all = buffers[buffer].data;
    if (offset + length > all.size())
        fault(who, " reaches past the end of ", element("buffers", buffer), " (", offset + length,
              " bytes of ", all.size(), ")");
    const Stream stream{std::span(all).subspan(offset, length), from["count"], from["byteStride"],
                        from["mode"], from.value("filter", "NONE")};
    checkStream(stream, who);
    if (view.value("byteStride", stream.stride) != stream.stride)
        fault(who, ".byteStride is not that of its bufferView");
    if (const uint64_t whole = view["byteLength"]; whole != stream.count * stream.stride)
        fault(who, " becomes ", stream.count * stream.stride, " bytes, but its bufferView has ", whole);
    return stream;
}

std::vector<uint8_t> decode(const Stream& stream, const std::string& who) {
    const auto [bytes, count, stride, mode, filter] = stream;
    std::vector<uint8_t> decoded(count * stride);
    void* const to = decoded.data();
    const int problem =
        mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to, count, stride, bytes.data(), bytes.size())
        : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(to, count, stride, bytes.data(), bytes.size())
                              : meshopt_decodeIndexSequence(to, count, stride, bytes.data(), bytes.size());
    if (problem != 0) fault(who, " holds a broken stream");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, stride);
    return decoded;
}

} // namespace

void keepCompression(Json& root) {
    for (const char* list : {"buffers", "bufferViews"}) {
        const auto found = root.find(list);
        if (found == root.end() || !found->is_array()) continue;
        for (Json& each : *found) {
            if (!each.is_object()) continue;
            each.erase(kName);
            const auto extensions = each.find("extensions");
            if (extensions == each.end() || !extensions->is_object() || !extensions->contains(kName))
                continue;
            Json kept = std::move((*extensions)[kName]);
            each[kName] = std::move(kept);
        }
    }
}

std::set<size_t> replacedBuffers(const Json& root, bool hasBinary) {
    std::set<size_t> replaced;
    if (!root.contains("buffers")) return replaced;
    const Json& buffers = root["buffers"];
    for (size_t i = 0; i < buffers.size(); ++i)
        if (buffers[i].contains(kName) && buffers[i][kName].value("fallback", false)) replaced.insert(i);
    if (!root.contains("bufferViews")) return replaced;
    for (const Json& view : root["bufferViews"]) {
        const size_t buffer = view["buffer"];
        const bool hasBytes = buffers[buffer].contains("uri") || (buffer == 0 && hasBinary);
        if (view.contains(kName) && !hasBytes) replaced.insert(buffer);
    }
    return replaced;
}

void decompressViews(GltfFile& file, Json& root, std::vector<tinygltf::Buffer>& buffers) {
    const auto views = root.find("bufferViews");
    if (views == root.end()) return;
    for (size_t i = 0; i < views->size(); ++i) {
        Json& view = (*views)[i];
        if (!view.contains(kName)) continue;
        const std::string who = element("bufferViews", i) + "." + kName;
        const Stream stream = streamOf(view, buffers, who);
        file.bytes.spend(stream.count * stream.stride, who);
        std::vector<uint8_t> decoded = decode(stream, who);
        view.erase(kName);
        view["buffer"] = buffers.size();
        view["byteOffset"] = 0;
        buffers.emplace_back().data = std::move(decoded);
    }
}

} // namespace shoal::scene
