#include "engine/media/HdrFormats.h"

#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>

namespace shoal::media {

namespace {

// Reads lines of RGBE pixels; false when the bytes end or make no sense.
struct LineReader {
    ByteSpan bytes;
    size_t at;

    bool has(size_t count) const { return bytes.size() - at >= count; }

    // Each of the four components by itself: a count above 128 repeats the next byte count - 128 times, a
    // count up to 128 is followed by so many bytes.
    bool coded(std::span<uint8_t> line, size_t width) {
        at += 4;
        for (size_t component = 0; component < 4; ++component)
            for (size_t x = 0; x < width;) {
                if (!has(2)) return false;
                const size_t code = bytes[at++];
                const bool repeat = code > 128;
                const size_t count = repeat ? code - 128 : code;
                if (count == 0 || count > width - x || !has(repeat ? 1 : count)) return false;
                for (size_t i = 0; i < count; ++i, ++x) line[4 * x + component] = bytes[repeat ? at : at + i];
                at += repeat ? 1 : count;
            }
        return true;
    }

    // Pixels one after the other; mantissas of 1 1 1 repeat the pixel before, in base 256 if in a row.
    bool flat(std::span<uint8_t> line, size_t width) {
        int shift = 0;
        for (size_t x = 0; x < width;) {
            if (!has(4)) return false;
            const ByteSpan pixel = bytes.subspan(at, 4);
            at += 4;
            if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                if (x == 0 || shift > 16) return false;
                const size_t count = size_t{pixel[3]} << shift;
                if (count > width - x) return false;
                for (size_t i = 0; i < count; ++i, ++x) std::memcpy(&line[4 * x], &line[4 * (x - 1)], 4);
                shift += 8;
            } else {
                std::memcpy(&line[4 * x++], pixel.data(), 4);
                shift = 0;
            }
        }
        return true;
    }

    bool next(std::span<uint8_t> line, size_t width) {
        const bool isCoded = width >= 8 && width < 32768 && has(4) && bytes[at] == 2 && bytes[at + 1] == 2 &&
                             big16(bytes, at + 2) == width;
        return isCoded ? coded(line, width) : flat(line, width);
    }
};

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

Result<ImageRgbF> decodeRadiance(ByteSpan bytes, int width, int height) {
    const size_t empty = asText(bytes).find("\n\n");
    const size_t resolutionEnd =
        empty == std::string_view::npos ? empty : asText(bytes).find('\n', empty + 2);
    if (resolutionEnd == std::string_view::npos) return Error{"", "its Radiance header is cut short"};
    if (asText(bytes.first(empty)).find("FORMAT=32-bit_rle_xyze") != std::string_view::npos)
        return Error{"", "is coded in XYZ; convert it to RGB"};
    // Before memory is taken: even the shortest line takes a pixel.
    const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
    if ((bytes.size() - resolutionEnd) / 4 < h) return Error{"", "is cut short"};

    std::array<float, 256> factor{};
    for (size_t e = 1; e < 256; ++e) factor[e] = std::ldexp(1.0f, static_cast<int>(e) - 136);
    ImageRgbF image(width, height);
    std::vector<uint8_t> line(4 * w);
    LineReader reader{bytes, resolutionEnd + 1};
    for (int y = 0; y < height; ++y) {
        if (!reader.next(line, w)) return Error{"", "is damaged or cut short at row " + std::to_string(y)};
        float* out = image.at(0, y);
        for (size_t x = 0; x < w; ++x)
            for (size_t c = 0; c < 3; ++c)
                *out++ = static_cast<float>(line[4 * x + c]) * factor[line[4 * x + 3]];
    }
    return image;
}

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
