#include "engine/render/software/PaintTexels.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"
#include "engine/render/software/FrameSampler.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace shoal::render {

namespace {

// A bilinear function over a tile: its value at the first texel's corner, and differences to the others.
template <class V> struct Patch {
    V first, right, down, both;

    V rowStart(float y) const { return first + y * down; }
    V rowStep(float y) const { return right + y * both; }
};

template <class V> Patch<V> patchOf(const std::array<V, 4>& corners) {
    return {corners[0], corners[1] - corners[0], corners[2] - corners[0],
            corners[0] - corners[1] - corners[2] + corners[3]};
}

glm::vec3 scatteredAt(const ImageRgbF& light, const glm::vec2& uv) {
    const glm::ivec2 size(light.width, light.height);
    const glm::vec2 at = uv * glm::vec2(size) - 0.5f, low = glm::floor(at), share = at - low;
    const auto texel = [&](int right, int down) {
        const int x = (static_cast<int>(low.x) + right + size.x) % size.x;
        const int y = std::clamp(static_cast<int>(low.y) + down, 0, size.y - 1);
        const float* c = light.at(x, y);
        return glm::vec3(c[0], c[1], c[2]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x), glm::mix(texel(0, 1), texel(1, 1), share.x),
                    share.y);
}

#ifdef SHOAL_AVX2

struct Colours { // of eight texels
    __m256 b, g, r, a;
};

SHOAL_AVX2 __m256 all(float value) { return _mm256_set1_ps(value); }
SHOAL_AVX2 __m256 mix(__m256 a, __m256 b, __m256 share) { return a + share * (b - a); }
SHOAL_AVX2 __m256 channel(__m256i pixels, int shift) {
    return _mm256_cvtepi32_ps(_mm256_and_si256(_mm256_srli_epi32(pixels, shift), _mm256_set1_epi32(0xff)));
}
SHOAL_AVX2 __m256 luma(__m256 b, __m256 g, __m256 r) { return 0.2126f * r + (0.7152f * g + 0.0722f * b); }

// Samples the layer along eight rays, from `ray` on; 0 to 255. Returns false if all of it is empty.
SHOAL_AVX2 bool seen(const TexelPaint& paint, const glm::vec3& ray, const glm::vec3& step, Colours& out) {
    const __m256 k = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
    const auto along = [&](int axis) SHOAL_AVX2 { return ray[axis] + k * step[axis]; };
    const __m256 perAhead = 1.0f / _mm256_max_ps(-along(2), all(1e-4f));
    const auto place = [&](int axis) SHOAL_AVX2 {
        return (along(axis) * perAhead - paint.rayShift[axis]) * (1 / paint.rayScale[axis]);
    };
    const __m256 x = place(0), y = place(1);
    const __m256 positive = _mm256_castsi256_ps(_mm256_set1_epi32(0x7fffffff));
    const __m256 inside = _mm256_cmp_ps(_mm256_max_ps(_mm256_and_ps(x, positive), _mm256_and_ps(y, positive)),
                                        all(1), _CMP_LE_OQ);
    if (_mm256_testz_ps(inside, inside)) return false;
    const auto texels = [&](__m256 at, int size) SHOAL_AVX2 {
        const __m256 t = (at + 1.0f) * (0.5f * static_cast<float>(size)) - 0.5f;
        return _mm256_min_ps(_mm256_max_ps(t, all(0)), all(static_cast<float>(size - 1)));
    };
    const auto floorOf = [&](__m256 t, int size) SHOAL_AVX2 {
        return _mm256_min_epi32(_mm256_cvttps_epi32(t), _mm256_set1_epi32(size - 2));
    };
    const __m256 s = texels(x, paint.layerSize.x), t = texels(y, paint.layerSize.y);
    const __m256i column = floorOf(s, paint.layerSize.x), row = floorOf(t, paint.layerSize.y);
    const __m256i at =
        _mm256_add_epi32(_mm256_mullo_epi32(row, _mm256_set1_epi32(paint.layerSize.x)), column);
    const auto* layer = reinterpret_cast<const int*>(paint.layer);
    const auto fetch = [&](int offset) SHOAL_AVX2 { return _mm256_i32gather_epi32(layer + offset, at, 4); };
    const __m256i corners[4] = {fetch(0), fetch(1), fetch(paint.layerSize.x), fetch(paint.layerSize.x + 1)};
    const __m256i any = _mm256_and_si256(
        _mm256_castps_si256(inside),
        _mm256_or_si256(_mm256_or_si256(corners[0], corners[1]), _mm256_or_si256(corners[2], corners[3])));
    if (_mm256_testz_si256(any, _mm256_set1_epi32(static_cast<int>(0xff000000u)))) return false;
    const __m256 u = s - _mm256_cvtepi32_ps(column), v = t - _mm256_cvtepi32_ps(row);
    const auto mixed = [&](int shift) SHOAL_AVX2 {
        return _mm256_and_ps(inside, mix(mix(channel(corners[0], shift), channel(corners[1], shift), u),
                                         mix(channel(corners[2], shift), channel(corners[3], shift), u), v));
    };
    out = {mixed(0), mixed(8), mixed(16), mixed(24)};
    return true;
}

SHOAL_AVX2 __m256 besideOf(__m256 c) { return _mm256_permute_ps(c, _MM_SHUFFLE(2, 3, 0, 1)); }

// Returns the mean over the texels that share a colour, of two rows.
SHOAL_AVX2 __m256 sharedBy(const glm::vec2& shares, __m256 row, __m256 otherRow) {
    const __m256 down = mix(row, otherRow, all(0.5f * shares.y));
    return mix(down, besideOf(down), all(0.5f * shares.x));
}

// Rounds to 0 to 255 and shifts into place.
SHOAL_AVX2 __m256i byte(__m256 c, int shift) {
    const __m256 bounded = _mm256_min_ps(_mm256_max_ps(c, all(0)), all(255));
    return _mm256_slli_epi32(_mm256_cvtps_epi32(bounded), shift);
}

SHOAL_AVX2 __m256i packed(__m256 b, __m256 g, __m256 r) {
    return _mm256_or_si256(_mm256_or_si256(byte(b, 0), byte(g, 8)),
                           _mm256_or_si256(byte(r, 16), _mm256_set1_epi32(static_cast<int>(0xff000000u))));
}

// Interpolates noise's deviation by luma in a table of eight bands.
SHOAL_AVX2 __m256 between(const std::array<float, 8>& table, __m256i below, __m256 share) {
    const __m256 values = _mm256_loadu_ps(table.data());
    return mix(_mm256_permutevar8x32_ps(values, below),
               _mm256_permutevar8x32_ps(values, _mm256_add_epi32(below, _mm256_set1_epi32(1))), share);
}

// Returns the sum of both grains at eight texels from this one on.
SHOAL_AVX2 __m256 grainAt(const TexelPaint& paint, int x, int y, __m256 light) {
    const CameraUniforms& n = *paint.filmed;
    const uint8_t* row = paint.grain + size_t{2} * kGrainSize * ((y + n.grainShift.y) & (kGrainSize - 1));
    const __m256i columns = _mm256_and_si256(
        _mm256_add_epi32(_mm256_set1_epi32(x + n.grainShift.x), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)),
        _mm256_set1_epi32(kGrainSize - 1));
    // Each load has two grains: the one asked for and its neighbour.
    const __m256i pairs =
        _mm256_i32gather_epi32(reinterpret_cast<const int*>(row), _mm256_srli_epi32(columns, 1), 4);
    const __m256i grains =
        _mm256_srlv_epi32(pairs, _mm256_slli_epi32(_mm256_and_si256(columns, _mm256_set1_epi32(1)), 4));
    const auto signedOf = [&](int shift) SHOAL_AVX2 {
        return (channel(grains, shift) * (2 / 255.0f) - 1.0f) * n.perGrain;
    };
    const __m256 band = _mm256_min_ps(_mm256_max_ps(light * 8.0f - 0.5f, all(0)), all(6.999f));
    const __m256i below = _mm256_cvttps_epi32(band);
    const __m256 share = band - _mm256_cvtepi32_ps(below);
    return signedOf(0) * between(n.fineNoise, below, share) +
           signedOf(8) * between(n.coarseNoise, below, share);
}

// Films eight texels from (x, y) on. c: of the layer, c2: of the row that it shares colours with.
SHOAL_AVX2 __m256i filmed(const TexelPaint& paint, const Colours& c, const Colours& c2, __m256i behind, int x,
                          int y, const glm::vec3& glow, const glm::vec3& glowStep) {
    const CameraUniforms& n = *paint.filmed;
    const __m256 covered = _mm256_cmp_ps(c.a, all(0.002f * 255), _CMP_GE_OQ);
    const __m256 perAlpha = 1.0f / _mm256_max_ps(c.a, all(0.25f));
    __m256 own[3] = {c.b * perAlpha, c.g * perAlpha, c.r * perAlpha};
    if (n.shares != glm::vec2(0)) {
        const __m256 alpha = sharedBy(n.shares, c.a, c2.a);
        const __m256 square[3] = {sharedBy(n.shares, c.b, c2.b), sharedBy(n.shares, c.g, c2.g),
                                  sharedBy(n.shares, c.r, c2.r)};
        const __m256 enough = _mm256_cmp_ps(alpha, all(0.01f * 255), _CMP_GT_OQ);
        const __m256 per = 1.0f / _mm256_max_ps(alpha, all(0.25f));
        const __m256 ownLuma = luma(own[0], own[1], own[2]),
                     squareLuma = luma(square[0], square[1], square[2]);
        for (int k = 0; k < 3; ++k) {
            const __m256 hue = (square[k] - squareLuma) * per;
            own[k] = _mm256_blendv_ps(own[k], _mm256_max_ps(ownLuma + hue, all(0)), enough);
        }
    }
    const __m256 alpha = c.a * (1 / 255.0f);
    const __m256 steps = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
    __m256 shown[3];
    for (int k = 0; k < 3; ++k) { // blue first; vectors have red first
        const int rgb = 2 - k;
        const __m256 levelled = n.black[rgb] + n.range[rgb] * own[k];
        const __m256 around = glow[rgb] + steps * glowStep[rgb];
        const __m256 light = mix(levelled * levelled, around, all(n.glare));
        const __m256 was = channel(behind, 8 * k) * (1 / 255.0f);
        shown[k] = _mm256_sqrt_ps(_mm256_max_ps(mix(was * was, light, alpha), all(0)));
    }
    if (n.perGrain > 0) {
        const __m256 noise = alpha * grainAt(paint, x, y, luma(shown[0], shown[1], shown[2]));
        for (__m256& value : shown) value += noise;
    }
    return _mm256_blendv_epi8(behind, packed(shown[0] * 255.0f, shown[1] * 255.0f, shown[2] * 255.0f),
                              _mm256_castps_si256(covered));
}

SHOAL_AVX2 __m256i laidOver(const Colours& c, __m256i behind) {
    const __m256 open = 1.0f - c.a * (1 / 255.0f);
    const auto over = [&](__m256 own, int shift) SHOAL_AVX2 { return own + open * channel(behind, shift); };
    return packed(over(c.b, 0), over(c.g, 8), over(c.r, 16));
}

} // namespace

SHOAL_AVX2 void paintTexels(const DisplayFrame& frame, const TexelPaint& paint, const glm::ivec2& low,
                            const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride) {
    assert(canSampleFrames() && paint.layerSize.x >= 2 && paint.layerSize.y >= 2);
    std::array<glm::vec3, 4> rays, glows{};
    for (size_t k = 0; k < 4; ++k) {
        const glm::vec2 uv =
            glm::vec2(k & 1 ? high.x : low.x, k >> 1 ? high.y : low.y) / glm::vec2(frame.width, frame.height);
        rays[k] = paint.eyeFromEnv * directionFromLatLong(uv);
        if (paint.filmed) glows[k] = scatteredAt(*paint.scattered, uv);
    }
    const Patch<glm::vec3> ray = patchOf(rays), glow = patchOf(glows);
    const glm::vec2 perTexel = 1.0f / glm::vec2(high - low);
    const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    // Squares of two by two texels share a colour: two rows at a time, from even ones.
    for (int y0 = low.y & ~1; y0 < high.y; y0 += 2)
        for (int x0 = low.x & ~1; x0 < high.x; x0 += 8) {
            const float x = (static_cast<float>(x0 - low.x) + 0.5f) * perTexel.x;
            std::array<Colours, 2> rows;
            bool any = false;
            for (int k = 0; k < 2; ++k) {
                const float y = (static_cast<float>(y0 + k - low.y) + 0.5f) * perTexel.y;
                const glm::vec3 step = ray.rowStep(y);
                Colours& c = rows[static_cast<size_t>(k)];
                if (seen(paint, ray.rowStart(y) + x * step, perTexel.x * step, c))
                    any = true;
                else
                    c = {all(0), all(0), all(0), all(0)};
            }
            const __m256i column = _mm256_add_epi32(_mm256_set1_epi32(x0), lanes);
            const __m256i mine = _mm256_andnot_si256(_mm256_cmpgt_epi32(_mm256_set1_epi32(low.x), column),
                                                     _mm256_cmpgt_epi32(_mm256_set1_epi32(high.x), column));
            for (int k = 0; k < 2; ++k) {
                const int at = y0 + k;
                if (at < low.y || at >= high.y) continue;
                const auto* from = reinterpret_cast<const int*>(frame.pixels);
                __m256i texels = _mm256_maskload_epi32(from + ptrdiff_t{at} * frame.rowPixels + x0, mine);
                const auto r = static_cast<size_t>(k);
                if (any && paint.filmed) {
                    const float y = (static_cast<float>(at - low.y) + 0.5f) * perTexel.y;
                    const glm::vec3 step = glow.rowStep(y);
                    texels = filmed(paint, rows[r], rows[1 - r], texels, x0, at, glow.rowStart(y) + x * step,
                                    perTexel.x * step);
                } else if (any) {
                    texels = laidOver(rows[r], texels);
                }
                _mm256_maskstore_epi32(reinterpret_cast<int*>(out) + at * outStride + x0, mine, texels);
            }
        }
}

#else

} // namespace

void paintTexels(const DisplayFrame&, const TexelPaint&, const glm::ivec2&, const glm::ivec2&, uint32_t*,
                 ptrdiff_t) {}

#endif

} // namespace shoal::render
