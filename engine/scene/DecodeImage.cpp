#include "engine/scene/Gltf.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <jpeglib.h> // behind <cstdio>, which it needs

#include <jerror.h>

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
constexpr const char* kBroken = " is broken or cut short";

int countScans(std::span<const uint8_t> bytes) {
    int scans = 0;
    for (size_t i = 0; i + 1 < bytes.size(); ++i) scans += bytes[i] == 0xFF && bytes[i + 1] == 0xDA;
    return scans;
}

struct JpegErrors : jpeg_error_mgr {
    std::jmp_buf failed{};
};

void decodeJpeg(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who, ImageRgba8& image) {
    JpegErrors errors;
    jpeg_decompress_struct jpeg{};
    const std::unique_ptr<jpeg_decompress_struct, decltype(&jpeg_destroy_decompress)> owned(
        &jpeg, jpeg_destroy_decompress);
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr info) {
        std::longjmp(static_cast<JpegErrors*>(info->err)->failed, 1);
    };
    errors.emit_message = [](j_common_ptr info, int) { // libjpeg would make up the pixels that are missing
        const int code = info->err->msg_code;
        if (code == JWRN_HIT_MARKER || code == JWRN_JPEG_EOF) info->err->error_exit(info);
    };
    if (setjmp(errors.failed) != 0) fault(who, kBroken);
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
    file.pixels.spend(uint64_t{1} * jpeg.image_width * jpeg.image_height, who);
    if (countScans(bytes) > kMaxScans) fault(who, " has more than ", kMaxScans, " scans");
    image = ImageRgba8(static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height));
    jpeg.out_color_space = JCS_EXT_RGBA; // of libjpeg-turbo
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = image.at(0, static_cast<int>(jpeg.output_scanline));
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
}

} // namespace

ImageRgba8 decodeImage(GltfFile& file, std::span<const uint8_t> bytes, const std::string& who) {
    ImageRgba8 image;
    if (bytes.size() > 1 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
        decodeJpeg(file, bytes, who, image);
        return image;
    }
    const auto size = static_cast<int>(bytes.size()); // files are smaller than 2 GiB
    largestPiece = 1 << 20;
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width < 1 || height < 1)
        fault(who, " is not a PNG or JPEG image that can be read");
    const uint64_t pixels = uint64_t{1} * width * height;
    file.pixels.spend(pixels, who);
    // The largest allocations hold four channels of 16 bits and the compressed data, both in buffers that
    // grow by doubling.
    largestPiece = pixels * 16 + bytes.size() * 2 + 65536;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!data || uint64_t{1} * width * height != pixels) fault(who, kBroken);
    image = ImageRgba8(width, height);
    std::memcpy(image.pixels.data(), data.get(), image.pixels.size());
    return image;
}

} // namespace shoal::scene
