// A reader of Radiance RGBE files, as far as the reference environments need it, so that the accuracy of the
// light is measured without engine/media.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

namespace shoal {

inline std::optional<ImageRgbF> readRadianceFile(const Path& file) {
    const auto text = readText(file, 64u << 20);
    if (!text) return std::nullopt;
    const std::string& bytes = *text;
    size_t at = bytes.find("\n\n");
    int width = 0, height = 0;
    if (at == std::string::npos || std::sscanf(bytes.c_str() + at, "\n\n-Y %d +X %d", &height, &width) != 2)
        return std::nullopt;
    at = bytes.find('\n', at + 2) + 1;
    if (width < 8 || width > 32767 || height < 1 || height > 32767) return std::nullopt;

    ImageRgbF image(width, height);
    std::vector<uint8_t> row(static_cast<size_t>(width) * 4); // four planes
    for (int y = 0; y < height; ++y) {
        at += 4; // 2, 2, width: a run-length coded row
        for (size_t filled = 0; filled < row.size();) {
            if (at + 1 >= bytes.size()) return std::nullopt;
            size_t count = static_cast<uint8_t>(bytes[at++]);
            const bool run = count > 128;
            if (run) count -= 128;
            if (count == 0 || filled + count > row.size() || at + (run ? 1 : count) > bytes.size())
                return std::nullopt;
            for (size_t i = 0; i < count; ++i)
                row[filled++] = static_cast<uint8_t>(bytes[at + (run ? 0 : i)]);
            at += run ? 1 : count;
        }
        for (int x = 0; x < width; ++x) {
            const int exponent = row[3 * width + x];
            const float scale = exponent ? std::ldexp(1.0f, exponent - 136) : 0.0f;
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = scale * static_cast<float>(row[c * width + x]);
        }
    }
    return image;
}

} // namespace shoal
