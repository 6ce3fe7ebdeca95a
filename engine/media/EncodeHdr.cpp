// High dynamic range pictures as the bytes of their files. Not through OpenCV, which codes these kinds into a
// file in the system's temporary folder, and does not notice when that is full.
#include "engine/media/EncodeHdr.h"

#include <bit>
#include <cassert>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace shoal::media {

static_assert(std::endian::native == std::endian::little, "a negative scale marks little-endian values");

std::string encodeRadiance(const ImageRgbF& image) {
    assert(!image.empty());
    std::string bytes;
    bytes.reserve(image.pixels.size() * 4 / 3 + 128);
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<size_t>(size));
    };
    stbi_write_hdr_to_func(append, &bytes, image.width, image.height, 3, image.pixels.data());
    return bytes;
}

std::string encodePfm(const ImageRgbF& image) {
    assert(!image.empty());
    std::string bytes =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    const size_t row = static_cast<size_t>(image.width) * 3 * sizeof(float);
    for (int y = image.height - 1; y >= 0; --y) // the bottom row comes first
        bytes.append(reinterpret_cast<const char*>(image.at(0, y)), row);
    return bytes;
}

} // namespace shoal::media
