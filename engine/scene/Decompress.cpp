// EXT_meshopt_compression: bufferViews whose bytes are decoded when the file is read.
#include "engine/scene/Gltf.h"

#include <meshoptimizer.h>

namespace shoal::scene {

namespace {

constexpr const char* kName = "EXT_meshopt_compression";

struct Stream {
    std::span<const uint8_t> bytes;
    size_t count, stride; // of what it becomes
    std::string mode, filter;
};

// Whether the extension's specification knows the stream's mode and filter, with that count and stride.
bool isKnown(const Stream& stream) {
    const auto& [bytes, count, stride, mode, filter] = stream;
    if (mode == "TRIANGLES" || mode == "INDICES")
        return filter == "NONE" && (stride == 2 || stride == 4) && (mode == "INDICES" || count % 3 == 0);
    if (mode != "ATTRIBUTES" || stride < 1 || stride > 256 || stride % 4 != 0) return false;
    return filter == "NONE" || filter == "EXPONENTIAL" || (filter == "OCTAHEDRAL" && stride <= 8) ||
           (filter == "QUATERNION" && stride == 8);
}

// Returns the stream of a view, which lies in its buffer and becomes as many bytes as the view has.
Stream streamOf(const Json& view, const std::vector<std::vector<uint8_t>>& buffers, const std::string& who) {
    const Json& from = extension(view, kName);
    const size_t buffer = from["buffer"], offset = from.value("byteOffset", size_t{0}),
                 length = from["byteLength"];
    const auto& all = buffers[buffer];
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

std::set<size_t> replacedBuffers(const Json& root, bool hasBinary) {
    std::set<size_t> replaced;
    for (const Json& view : member(root, "bufferViews")) {
        const size_t index = view["buffer"];
        const Json& buffer = root["buffers"][index];
        const bool hasBytes = buffer.contains("uri") || (index == 0 && hasBinary);
        const bool isMarked = extension(buffer, kName).value("fallback", false);
        if (!extension(view, kName).empty() && (isMarked || !hasBytes)) replaced.insert(index);
    }
    return replaced;
}

BufferView decompressed(GltfFile& file, const Json& view, const std::string& whose) {
    const std::string who = whose + ".extensions." + kName;
    const Stream stream = streamOf(view, file.buffers, who);
    const size_t bytes = stream.count * stream.stride;
    file.bytes.spend(bytes, who);
    file.buffers.push_back(decode(stream, who));
    return {file.buffers.size() - 1, 0, bytes, view.value("byteStride", size_t{0})};
}

} // namespace shoal::scene
