#include "engine/light/PackedLight.h"

#include "engine/core/Vectorise.h"
#include "engine/light/Pyramid.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace shoal::light {

namespace {

constexpr uint16_t kOne = 0x3c00; // 1 as a half float

// Rounds a value of 0 .. 65504 to the nearest half float, ties to even. It has no branches: loops vectorise.
inline uint16_t halfFromFloat(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t normal = (bits - (112u << 23) + 0xfffu + ((bits >> 13) & 1u)) >> 13;
    // Below 2^-14 half floats are multiples of 2^-24: the last digit of a float just above 1/2.
    const uint32_t small = std::bit_cast<uint32_t>(value + 0.5f) - std::bit_cast<uint32_t>(0.5f);
    return static_cast<uint16_t>(bits < 0x38800000u ? small : normal);
}

SHOAL_VECTORISE
void packRow(const float* __restrict rgb, int width, float factor, uint16_t* __restrict rgba) {
    for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c)
            rgba[4 * x + c] = halfFromFloat(std::min(factor * rgb[3 * x + c], kMaxHalf));
        rgba[4 * x + 3] = kOne;
    }
}

float brightest(const ImageRgbF& map) {
    return map.empty() ? 0 : *std::max_element(map.pixels.begin(), map.pixels.end());
}

// top: the atlas' row that holds the border above the map.
void packBordered(const ImageRgbF& map, float factor, int top, HalfImage& atlas) {
    const auto texels = [&](int x, int y) { return atlas.at(x + 1, top + 1 + y); };
    for (int y = 0; y < map.height; ++y) packRow(map.at(0, y), map.width, factor, texels(0, y));
    const int half = map.width / 2;
    for (const int y : {0, map.height - 1}) { // the row beyond a pole is the same row, half a turn on
        const int beyond = y == 0 ? -1 : map.height;
        std::copy_n(texels(0, y), half * 4, texels(half, beyond));
        std::copy_n(texels(half, y), half * 4, texels(0, beyond));
    }
    for (int y = -1; y <= map.height; ++y) {
        std::copy_n(texels(map.width - 1, y), 4, texels(-1, y));
        std::copy_n(texels(0, y), 4, texels(map.width, y));
    }
}

} // namespace

void packLight(const EnvironmentLight& light, MirrorMaps mirrors, PackedLight& out, TooBright tooBright) {
    size_t unfiltered = 0;
    int width = 0, height = 0;
    for (const GlossyLevel& level : light.glossy) {
        unfiltered += level.radianceLin.empty();
        if (level.radianceLin.empty()) continue;
        width = std::max(width, level.radianceLin.width + 2);
        height += level.radianceLin.height + 2;
    }
    assert(unfiltered < light.glossy.size());
    out.atlas.fit(width, height);
    out.mirrors.resize(mirrors == MirrorMaps::None      ? 0
                       : mirrors == MirrorMaps::Pyramid ? light.radiance.levels.size()
                                                        : unfiltered);
    out.scale = 1;
    if (tooBright == TooBright::Scale) {
        float most = kMaxHalf;
        for (const GlossyLevel& level : light.glossy) most = std::max(most, brightest(level.radianceLin));
        // The first level has the brightest texel: the others are means of it.
        if (!out.mirrors.empty()) most = std::max(most, brightest(light.radiance.levels[0]));
        out.scale = most / kMaxHalf;
    }
    const float factor = 1 / out.scale;

    out.places.clear();
    int top = 0;
    for (size_t k = light.glossy.size(); k-- > unfiltered;) {
        const ImageRgbF& map = light.glossy[k].radianceLin;
        packBordered(map, factor, top, out.atlas);
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        out.places.emplace_back(static_cast<float>(map.width) / w, static_cast<float>(map.height) / h, 1 / w,
                                static_cast<float>(top + 1) / h);
        top += map.height + 2;
    }

    out.mirrorRoughness.clear();
    for (size_t k = 0; k <= unfiltered; ++k) out.mirrorRoughness.push_back(light.glossy[k].roughness);
    for (size_t k = 0; k < out.mirrors.size(); ++k) {
        const ImageRgbF& map = light.radiance.levels[k];
        out.mirrors[k].fit(map.width, map.height);
        packRow(map.pixels.data(), map.width * map.height, factor, out.mirrors[k].pixels.data());
    }
}

} // namespace shoal::light
