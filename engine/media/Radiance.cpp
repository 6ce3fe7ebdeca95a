#include "engine/media/Radiance.h"

#include "engine/media/Bytes.h"

#include <array>
#include <cmath>
#include <cstring>

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

} // namespace shoal::media
