#include "engine/render/software/PaintTexels.h"

#include "engine/core/Vectorise.h"
#include "engine/light/Lookup.h"
#include "engine/math/LatLong.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace shoal::render {

namespace {

constexpr int kLanes = 16; // texels of a row painted at once: compilers vectorise loops of this length
using Lanes = std::array<float, kLanes>;
using Colours = std::array<Lanes, 4>; // blue, green, red, alpha: 0 to 255, premultiplied

// A bilinear function over a tile: its value at the first corner, and its differences to the other corners.
struct Patch {
    glm::vec3 first, right, down, both;

    explicit Patch(const std::array<glm::vec3, 4>& corners)
        : first(corners[0]), right(corners[1] - corners[0]), down(corners[2] - corners[0]),
          both(corners[0] - corners[1] - corners[2] + corners[3]) {}
    glm::vec3 at(const glm::vec2& place) const { return first + place.y * down + place.x * stepAt(place.y); }
    glm::vec3 stepAt(float y) const { return right + y * both; }
};

inline float mix(float a, float b, float share) { return a + share * (b - a); }
inline float bounded(float value, float low, float high) {
    value = value < low ? low : value;
    return value > high ? high : value;
}
inline float luma(float b, float g, float r) { return 0.2126f * r + (0.7152f * g + 0.0722f * b); }
inline float channel(uint32_t texel, int c) {
    return static_cast<float>(static_cast<int>(texel >> (8 * c) & 255));
}
inline float signedOf(int grain) { return static_cast<float>(grain) * (2 / 255.0f) - 1; }
inline uint32_t byte(float value) {
    return static_cast<uint32_t>(static_cast<int>(bounded(value, 0, 255) + 0.5f));
}
inline uint32_t packed(float b, float g, float r) {
    return byte(b) | byte(g) << 8 | byte(r) << 16 | 0xff000000u;
}

// Samples the layer in kLanes directions: `ray`, then one for every `step`. Returns false if all are empty.
SHOAL_VECTORISE bool sampleLayer(const TexelPaint& paint, const glm::vec3& ray, const glm::vec3& step,
                                 Colours& out) {
    const int width = paint.layerSize.x, lastColumn = width - 2, lastRow = paint.layerSize.y - 2;
    const glm::vec2 perScale = 1.0f / paint.rayScale, half = 0.5f * glm::vec2(paint.layerSize);
    std::array<int, kLanes> at;
    Lanes inside, u, v;
    for (int k = 0; k < kLanes; ++k) {
        const auto n = static_cast<float>(k);
        const float ahead = -(ray.z + n * step.z), perAhead = 1 / (ahead > 1e-4f ? ahead : 1e-4f);
        const float x = ((ray.x + n * step.x) * perAhead - paint.rayShift.x) * perScale.x;
        const float y = ((ray.y + n * step.y) * perAhead - paint.rayShift.y) * perScale.y;
        inside[k] = (std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y)) <= 1 ? 1.0f : 0.0f;
        const float s = bounded((x + 1) * half.x - 0.5f, 0, 2 * half.x - 1);
        const float t = bounded((y + 1) * half.y - 0.5f, 0, 2 * half.y - 1);
        int column = static_cast<int>(s), row = static_cast<int>(t);
        column = column < lastColumn ? column : lastColumn;
        row = row < lastRow ? row : lastRow;
        at[k] = row * width + column;
        u[k] = s - static_cast<float>(column);
        v[k] = t - static_cast<float>(row);
    }
    using Texels = std::array<uint32_t, kLanes>;
    Texels a, b, c, d;
    const uint32_t* layer = paint.layer;
    for (int k = 0; k < kLanes; ++k) a[k] = layer[at[k]];
    for (int k = 0; k < kLanes; ++k) b[k] = layer[at[k] + 1];
    for (int k = 0; k < kLanes; ++k) c[k] = layer[at[k] + width];
    for (int k = 0; k < kLanes; ++k) d[k] = layer[at[k] + width + 1];
    uint32_t any = 0;
    for (int k = 0; k < kLanes; ++k) any |= inside[k] > 0 ? a[k] | b[k] | c[k] | d[k] : 0;
    if (any >> 24 == 0) return false;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < kLanes; ++k)
            out[i][k] = inside[k] * mix(mix(channel(a[k], i), channel(b[k], i), u[k]),
                                        mix(channel(c[k], i), channel(d[k], i), u[k]), v[k]);
    return true;
}

// Composites the layer over texels as the video's camera would have filmed it. c: the layer's colours; c2:
// those of the row that shares chroma with it; place: of the first texel; glow: scattered light there.
SHOAL_VECTORISE void film(const TexelPaint& paint, const Colours& c, const Colours& c2,
                          const glm::ivec2& place, const glm::vec3& glow, const glm::vec3& glowStep,
                          uint32_t* texels) {
    const CameraUniforms n = *paint.filmed;
    Colours square; // mean colour of the texels that share chroma, over both rows
    for (int i = 0; i < 4; ++i) {
        Lanes down;
        for (int k = 0; k < kLanes; ++k) down[k] = mix(c[i][k], c2[i][k], 0.5f * n.shares.y);
        for (int k = 0; k < kLanes; ++k) square[i][k] = mix(down[k], down[k ^ 1], 0.5f * n.shares.x);
    }
    int fine[kLanes], coarse[kLanes]; // grain, 0 to 255
    const glm::ivec2 shifted = place + n.grainShift;
    const uint8_t* grainRow = grains().data() + 2 * kGrainSize * (shifted.y & (kGrainSize - 1));
    for (int k = 0; k < kLanes; ++k) {
        const uint8_t* grain = grainRow + 2 * ((shifted.x + k) & (kGrainSize - 1));
        fine[k] = grain[0], coarse[k] = grain[1];
    }
    Lanes ownLuma, squareLuma, perAlpha, perSquare;
    for (int k = 0; k < kLanes; ++k) {
        perAlpha[k] = 1 / (c[3][k] > 0.25f ? c[3][k] : 0.25f);
        perSquare[k] = 1 / (square[3][k] > 0.25f ? square[3][k] : 0.25f);
        ownLuma[k] = luma(c[0][k], c[1][k], c[2][k]) * perAlpha[k];
        squareLuma[k] = luma(square[0][k], square[1][k], square[2][k]);
    }
    float shown[3][kLanes];
    for (int i = 0; i < 3; ++i) { // lanes have blue first, glm vectors red first
        const float black = n.black[2 - i], range = n.range[2 - i], around = glow[2 - i],
                    aroundStep = glowStep[2 - i];
        for (int k = 0; k < kLanes; ++k) {
            const float hue = (square[i][k] - squareLuma[k]) * perSquare[k], sum = ownLuma[k] + hue;
            const float alone = c[i][k] * perAlpha[k], shared = sum > 0 ? sum : 0;
            const float levelled = black + range * (square[3][k] > 2.55f ? shared : alone);
            const float was = channel(texels[k], i) * (1 / 255.0f);
            const float light =
                mix(levelled * levelled, around + static_cast<float>(k) * aroundStep, n.glare);
            const float mixed = mix(was * was, light, c[3][k] * (1 / 255.0f));
            shown[i][k] = std::sqrt(mixed > 0 ? mixed : 0);
        }
    }
    const float* fineNoise = n.fineNoise.data();
    const float* coarseNoise = n.coarseNoise.data();
    const float perAlphaGrain = n.perGrain / 255;
    for (int k = 0; k < kLanes; ++k) {
        const float band = bounded(8 * luma(shown[0][k], shown[1][k], shown[2][k]) - 0.5f, 0, 6.999f);
        const int below = static_cast<int>(band);
        const float share = band - static_cast<float>(below), strength = c[3][k] * perAlphaGrain;
        const float noise =
            strength * (signedOf(fine[k]) * mix(fineNoise[below], fineNoise[below + 1], share) +
                        signedOf(coarse[k]) * mix(coarseNoise[below], coarseNoise[below + 1], share));
        for (int i = 0; i < 3; ++i) shown[i][k] += noise;
    }
    for (int k = 0; k < kLanes; ++k) {
        const uint32_t now = packed(255 * shown[0][k], 255 * shown[1][k], 255 * shown[2][k]);
        texels[k] = c[3][k] >= 0.002f * 255 ? now : texels[k];
    }
}

SHOAL_VECTORISE void layOver(const Colours& c, uint32_t* texels) {
    for (int k = 0; k < kLanes; ++k) {
        const float open = 1 - c[3][k] * (1 / 255.0f);
        texels[k] = packed(c[0][k] + open * channel(texels[k], 0), c[1][k] + open * channel(texels[k], 1),
                           c[2][k] + open * channel(texels[k], 2));
    }
}

} // namespace

void paintTexels(const TexelPaint& paint, const glm::ivec2& low, const glm::ivec2& high,
                 const glm::ivec2& frameSize, uint32_t* frame) {
    assert(paint.layerSize.x >= 2 && paint.layerSize.y >= 2);
    std::array<glm::vec3, 4> rays, glows{};
    for (size_t k = 0; k < 4; ++k) {
        const glm::vec2 uv =
            glm::vec2(k & 1 ? high.x : low.x, k >> 1 ? high.y : low.y) / glm::vec2(frameSize);
        const glm::vec3 dirEnv = directionFromLatLong(uv);
        rays[k] = paint.eyeFromEnv * dirEnv;
        if (paint.filmed) glows[k] = light::lookUp(*paint.scattered, dirEnv);
    }
    const Patch ray(rays), glow(glows);
    const glm::vec2 perTexel = 1.0f / glm::vec2(high - low);
    // Squares of 2 x 2 texels share chroma, so rows are painted in pairs that begin at an even row.
    for (int y0 = low.y & ~1; y0 < high.y; y0 += 2)
        for (int x0 = low.x & ~1; x0 < high.x; x0 += kLanes) {
            const auto placeOf = [&](int row) {
                return (glm::vec2(glm::ivec2(x0, y0 + row) - low) + 0.5f) * perTexel;
            };
            std::array<Colours, 2> rows{};
            bool any = false;
            for (const int k : {0, 1}) {
                const glm::vec2 place = placeOf(k);
                any |= sampleLayer(paint, ray.at(place), perTexel.x * ray.stepAt(place.y), rows[k]);
            }
            if (!any) continue;
            const int first = std::max(low.x - x0, 0), end = std::min(high.x - x0, kLanes);
            for (int y = std::max(y0, low.y); y < std::min(y0 + 2, high.y); ++y) {
                const int row = y - y0;
                uint32_t* line = frame + ptrdiff_t{y} * frameSize.x + x0;
                std::array<uint32_t, kLanes> texels{};
                std::copy(line + first, line + end, texels.begin() + first);
                const glm::vec2 place = placeOf(row);
                if (paint.filmed)
                    film(paint, rows[row], rows[1 - row], {x0, y}, glow.at(place),
                         perTexel.x * glow.stepAt(place.y), texels.data());
                else
                    layOver(rows[row], texels.data());
                std::copy(texels.begin() + first, texels.begin() + end, line + first);
            }
        }
}

} // namespace shoal::render
