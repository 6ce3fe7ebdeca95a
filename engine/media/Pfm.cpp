#include "engine/media/Pfm.h"

#include "engine/media/Bytes.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>

namespace shoal::media {

namespace {

// The third header field; `at` ends one past the single white space behind it. 0 if there is none.
float scaleOf(ByteSpan b, size_t& at) {
    at = 2;
    std::string_view field;
    for (int i = 0; i < 3; ++i) {
        while (at < b.size() && std::isspace(b[at])) ++at;
        const size_t begin = at;
        while (at < b.size() && !std::isspace(b[at])) ++at;
        field = asText(b.subspan(begin, at - begin));
    }
    ++at;
    float scale = 0;
    std::from_chars(field.data(), field.data() + field.size(), scale);
    return std::isfinite(scale) ? scale : 0;
}

} // namespace

Result<ImageRgbF> decodePfm(ByteSpan bytes, int width, int height) {
    const size_t channels = hasText(bytes, 0, "PF") ? 3 : 1;
    size_t at = 0;
    const float scale = scaleOf(bytes, at);
    if (scale == 0) return Error{"", "its PFM header is damaged"};
    const size_t needed = size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height) * channels;
    if (at > bytes.size() || bytes.size() - at < needed) return Error{"", "is cut short"};

    ImageRgbF image(width, height);
    const float factor = std::abs(scale);
    for (int y = height - 1; y >= 0; --y) {
        float* out = image.at(0, y);
        for (int x = 0; x < width; ++x) {
            for (size_t c = 0; c < 3; ++c) {
                const size_t component = at + (channels == 3 ? 4 * c : 0);
                const uint32_t bits = scale < 0 ? little32(bytes, component) : big32(bytes, component);
                *out++ = std::bit_cast<float>(bits) * factor;
            }
            at += 4 * channels;
        }
    }
    return image;
}

std::string encodePfm(const ImageRgbF& image) {
    static_assert(std::endian::native == std::endian::little);
    std::string text = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    const size_t rowBytes = size_t{12} * static_cast<size_t>(image.width);
    text.reserve(text.size() + rowBytes * static_cast<size_t>(image.height));
    for (int y = image.height - 1; y >= 0; --y)
        text.append(reinterpret_cast<const char*>(image.at(0, y)), rowBytes);
    return text;
}

} // namespace shoal::media
