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
    size_t count, stride; // of the decoded elements
    std::string mode, filter;
};

// Returns whether the specification allows the stream's mode and filter with its count and stride.
bool isKnown(const Stream& stream) {
    const auto& [bytes, count, stride, mode, filter] = stream;
    if (mode == "TRIANGLES" || mode == "INDICES")
        return filter == "NONE" && (stride == 2 || stride == 4) && (mode == "INDICES" || count % 3 == 0);
    if (mode != "ATTRIBUTES" || stride < 1 || stride > 256 || stride % 4 != 0) return false;
    return filter == "NONE" || filter == "EXPONENTIAL" || (filter == "OCTAHEDRAL" && stride <= 8) ||
           (filter == "QUATERNION" && stride == 8);
}

// Returns the stream of a view; checks that it lies in its buffer and decodes to the view's length.
Stream streamOf(const Json& view, const std::vector<tinygltf::Buffer>& buffers, const std::string& who) {
    const Json& from = view[kName];
    const size_t buffer = from["buffer"], offset = from.value("byteOffset", 0u), length = from["byteLength"];
    const auto& all = buffers[buffer].data;
    if (offset + length > all.size())
        fault(who, " reaches past the end of ", element("buffers", buffer), " (", offset + length,
              " bytes of ", all.size(), ")");
    const Stream stream{std::span(all).subspan(offset, length), from["count"], from["byteStride"],
                        from["mode"], from.value("filter", "NONE")};
    if (stream.count < 1) fault(who, ".count is 0");
    if (!isKnown(stream))
        fault(who, ": the mode ", quoted(stream.mode), " cannot have ", stream.count, " elements of ",
              stream.stride, " bytes with the filter ", quoted(stream.filter));
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
            const Json::json_pointer stated(std::string("/extensions/") + kName);
            if (each.contains(stated)) each[kName] = Json(each[stated]);
        }
    }
}

std::set<size_t> replacedBuffers(const Json& root, bool hasBinary) {
    std::set<size_t> replaced;
    for (const Json& view : root.value("bufferViews", Json::array())) {
        const size_t index = view["buffer"];
        const Json& buffer = root["buffers"][index];
        const bool hasBytes = buffer.contains("uri") || (index == 0 && hasBinary);
        const bool isMarked = buffer.contains(kName) && buffer[kName].value("fallback", false);
        if (view.contains(kName) && (isMarked || !hasBytes)) replaced.insert(index);
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
