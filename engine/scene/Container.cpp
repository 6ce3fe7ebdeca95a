#include "engine/scene/Container.h"

#include "engine/core/JsonBounds.h"
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

// A parsed value costs up to some 100 bytes, an object up to some 2000 in tinygltf: below 1 GiB in all.
void checkJsonSize(std::string_view json) {
    constexpr JsonBounds kBounds{.depth = 64, .values = 4'000'000, .objects = 500'000};
    if (const std::string exceeded = exceededBound(json, kBounds); !exceeded.empty())
        fault("its JSON ", exceeded);
}

} // namespace shoal::scene
