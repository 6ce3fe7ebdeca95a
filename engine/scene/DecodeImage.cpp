#include "engine/scene/Gltf.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace {

// Largest allocation that stb_image may make: a PNG's lengths and its compressed data can both ask for
// gigabytes, whatever its width and height. It is per thread, because stb's hooks carry no context.
thread_local size_t largestPiece = 0;

void* takePiece(size_t bytes) { return bytes <= largestPiece ? std::malloc(bytes) : nullptr; }
void* growPiece(void* old, size_t bytes) {
    return bytes <= largestPiece ? std::realloc(old, bytes) : nullptr;
}

} // namespace

#define STBI_MALLOC(bytes) takePiece(bytes)
#define STBI_REALLOC(old, bytes) growPiece(old, bytes)
#define STBI_FREE(old) std::free(old)
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS 32768
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace shoal::scene {

namespace {

// Limit of scans: each scan of a progressive JPEG costs as much as a whole decoding. Encoders make about ten.
constexpr int kMaxScans = 100;

// Returns whether a Huffman table of a JPEG lists more than 256 codes: stb_image before 2.28 trusts any
// number and writes past its tables, even when it only reads a picture's size. The search goes from marker to
// marker like stb's, but also past bytes that are no marker and through entropy-coded data. ITU-T T.81, B.1.1
// and B.2.4.2.
bool hasOverlongHuffmanTable(std::span<const uint8_t> bytes) {
    constexpr size_t kMaxCodes = 256,
                     kTableHeader = 17; // one byte of class and slot, 16 of code counts
    const auto byte = [&](size_t at) -> size_t { return at < bytes.size() ? bytes[at] : 0; };
    for (size_t at = 0; at < bytes.size();) {
        if (bytes[at++] != 0xFF) continue;
        while (byte(at) == 0xFF) ++at; // fill bytes
        const size_t marker = byte(at++);
        if (marker == 0xD9) return false; // end of the image
        // Stuffed zeros, restarts and the start of the image have no segment.
        if (marker == 0 || (marker >= 0xD0 && marker <= 0xD8)) continue;
        const size_t end = at + std::max<size_t>(byte(at) << 8 | byte(at + 1), 2);
        for (size_t table = at + 2; marker == 0xC4 && table < end;) {
            size_t codes = 0;
            for (size_t i = 1; i < kTableHeader; ++i) codes += byte(table + i);
            if (codes > kMaxCodes) return true;
            table += kTableHeader + codes;
        }
        at = end;
    }
    return false;
}

int countScans(std::span<const uint8_t> bytes) {
    int scans = 0;
    for (size_t i = 0; i + 1 < bytes.size(); ++i) scans += bytes[i] == 0xFF && bytes[i + 1] == 0xDA;
    return scans;
}

} // namespace

ImageRgba8 decodeImage(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who) {
    const auto size = static_cast<int>(bytes.size()); // files are smaller than 2 GiB
    if (!bytes.empty() && bytes[0] == 0xFF && hasOverlongHuffmanTable(bytes))
        fault(who, " has a Huffman table of more than 256 codes");
    largestPiece = 1 << 20; // the JPEG reader's state is some 20 KiB
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width < 1 || height < 1)
        fault(who, " is not a PNG or JPEG image that can be read");
    const uint64_t pixels = uint64_t{1} * width * height;
    file.pixels.spend(pixels, who);
    if (bytes[0] == 0xFF && countScans(bytes) > kMaxScans) fault(who, " has more than ", kMaxScans, " scans");

    // The largest allocations hold four channels of 16 bits and the compressed data, both in buffers that
    // grow by doubling. A progressive JPEG's coefficients have 16 bits, in blocks rounded up to its largest
    // sampling factor, 4.
    const uint64_t rounded = (uint64_t{32} + width) * (uint64_t{32} + height);
    largestPiece = rounded * 16 + bytes.size() * 2 + 65536;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!data || uint64_t{1} * width * height != pixels) fault(who, " is broken or cut short");
    ImageRgba8 image(width, height);
    std::memcpy(image.pixels.data(), data.get(), image.pixels.size());
    return image;
}

} // namespace shoal::scene
