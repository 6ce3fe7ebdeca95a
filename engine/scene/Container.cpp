#include "engine/scene/Container.h"

#include "engine/scene/Loading.h"

#include <cctype>
#include <cstring>

namespace shoal::scene {

namespace {

constexpr uint32_t kMagic = 0x46546C67;       // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;   // "JSON"
constexpr uint32_t kBinaryChunk = 0x004E4942; // "BIN"
constexpr size_t kHeaderBytes = 12;
constexpr size_t kChunkHeaderBytes = 8;

// A parsed value costs up to some 100 bytes, an object up to some 2000 in tinygltf: below 1 GiB in all.
constexpr uint64_t kMaxValues = 4'000'000;
constexpr uint64_t kMaxObjects = 500'000;
constexpr int kMaxDepth = 64;

uint32_t littleEndian32(std::span<const uint8_t> bytes, size_t at) {
    return static_cast<uint32_t>(bytes[at]) | static_cast<uint32_t>(bytes[at + 1]) << 8 |
           static_cast<uint32_t>(bytes[at + 2]) << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

} // namespace

Container openContainer(std::span<const uint8_t> file) {
    Container container;
    if (file.size() < 4 || littleEndian32(file, 0) != kMagic) {
        container.json = {reinterpret_cast<const char*>(file.data()), file.size()};
        return container;
    }
    if (file.size() < kHeaderBytes) fault("the GLB header is cut short");
    if (const uint32_t version = littleEndian32(file, 4); version != 2)
        fault("is GLB version ", version, ", not 2");
    const uint32_t length = littleEndian32(file, 8);
    if (length > file.size()) fault("the GLB header says ", length, " bytes, but the file has ", file.size());
    if (length < kHeaderBytes) fault("the GLB header says ", length, " bytes, fewer than the header itself");
    file = file.first(length);

    size_t at = kHeaderBytes;
    for (int chunk = 0; at < file.size(); ++chunk) {
        if (file.size() - at < kChunkHeaderBytes) fault("GLB chunk ", chunk, " is cut short");
        const uint32_t bytes = littleEndian32(file, at);
        const uint32_t type = littleEndian32(file, at + 4);
        at += kChunkHeaderBytes;
        if (bytes > file.size() - at) fault("GLB chunk ", chunk, " reaches past the end of the file");
        if (bytes % 4 != 0) fault("GLB chunk ", chunk, " has a length that is no multiple of 4");
        const auto data = file.subspan(at, bytes);
        at += bytes;
        if (chunk == 0) {
            if (type != kJsonChunk) fault("the first GLB chunk is not JSON");
            container.json = {reinterpret_cast<const char*>(data.data()), data.size()};
        } else if (type == kJsonChunk) {
            fault("there is a second JSON chunk in the GLB");
        } else if (type == kBinaryChunk) {
            if (chunk != 1) fault("the GLB's binary chunk is not the second");
            container.binary = data;
        } // Chunks of other types are to be ignored.
    }
    if (container.json.empty()) fault("the GLB holds no JSON chunk");
    return container;
}

void checkJsonSize(std::string_view json) {
    uint64_t values = 0, objects = 0;
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
            continue;
        }
        switch (c) {
        case '"':
            inString = true;
            break;
        case '{':
            ++objects;
            [[fallthrough]];
        case '[':
            if (++depth > kMaxDepth) fault("its JSON is nested deeper than ", kMaxDepth, " levels");
            break;
        case '}':
        case ']':
            --depth;
            break;
        case ',':
        case ':':
            ++values;
            break;
        default:
            break;
        }
        if (objects > kMaxObjects) fault("its JSON has more than ", kMaxObjects, " objects");
        if (values > kMaxValues) fault("its JSON has more than ", kMaxValues, " values");
    }
}

} // namespace shoal::scene
