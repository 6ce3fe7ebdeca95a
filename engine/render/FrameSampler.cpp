#include "engine/render/FrameSampler.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2")))
#endif

namespace shoal::render {

namespace {

constexpr float kOne = 65536; // fixed point

int fixed(float texels) { return static_cast<int>(std::lround(texels * kOne)); }

#ifdef SHOAL_AVX2

// Four pixels, each of two texels side by side in two rows: as 16-bit numbers of 127.5 times their value less
// 128, which is as much as they hold. across: 255 - w and w in the low bytes of each 32 bits; down: 15 bits.
SHOAL_AVX2
__m256i mixed(__m256i above, __m256i below, __m128i across, __m128i down) {
    const __m256i flip = _mm256_set1_epi8(static_cast<char>(0x80));
    const __m256i pairUp =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 4, 1, 5, 2, 6, 3, 7, 8, 12, 9, 13, 10, 14, 11, 15));
    const __m256i everyChannel =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 0, 1, 0, 1, 0, 1, 8, 9, 8, 9, 8, 9, 8, 9));
    const __m256i w = _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(across), everyChannel);
    const __m256i h = _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(down), everyChannel);
    const auto row = [&](__m256i texels) SHOAL_AVX2 {
        const __m256i pairs = _mm256_shuffle_epi8(_mm256_xor_si256(texels, flip), pairUp);
        return _mm256_srai_epi16(_mm256_maddubs_epi16(w, pairs), 1);
    };
    const __m256i a = row(above), b = row(below);
    const __m256i sum = _mm256_add_epi16(a, _mm256_mulhrs_epi16(_mm256_sub_epi16(b, a), h));
    return _mm256_mulhrs_epi16(sum, _mm256_set1_epi16(257)); // 2^15 / 127.5
}

// The same of eight, whose texels lie apart: left and right ones of the row above and of the one below, with
// 128 taken off.
SHOAL_AVX2
__m256i mixed(__m256i aboveLeft, __m256i aboveRight, __m256i belowLeft, __m256i belowRight, __m256i across,
              __m256i down) {
    const __m256i first =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 0, 1, 0, 1, 0, 1, 4, 5, 4, 5, 4, 5, 4, 5));
    const __m256i second =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(8, 9, 8, 9, 8, 9, 8, 9, 12, 13, 12, 13, 12, 13, 12, 13));
    const auto half = [&](__m256i above, __m256i below, __m256i which) SHOAL_AVX2 {
        const __m256i w = _mm256_shuffle_epi8(across, which), h = _mm256_shuffle_epi8(down, which);
        const __m256i a = _mm256_srai_epi16(_mm256_maddubs_epi16(w, above), 1);
        const __m256i b = _mm256_srai_epi16(_mm256_maddubs_epi16(w, below), 1);
        const __m256i sum = _mm256_add_epi16(a, _mm256_mulhrs_epi16(_mm256_sub_epi16(b, a), h));
        return _mm256_mulhrs_epi16(sum, _mm256_set1_epi16(257));
    };
    return _mm256_packs_epi16(
        half(_mm256_unpacklo_epi8(aboveLeft, aboveRight), _mm256_unpacklo_epi8(belowLeft, belowRight), first),
        half(_mm256_unpackhi_epi8(aboveLeft, aboveRight), _mm256_unpackhi_epi8(belowLeft, belowRight),
             second));
}

// s, t: of the first pixel, in fixed texels from the frame's first; ds, dt: from pixel to pixel.
SHOAL_AVX2
void sampleRow(const CodedFrame& frame, int s, int t, int ds, int dt, int count, uint32_t* out) {
    const __m256i steps = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), one = _mm256_set1_epi32(1);
    const __m256i flip = _mm256_set1_epi8(static_cast<char>(0x80));
    const __m256i stride = _mm256_set1_epi32(frame.rowPixels);
    // The last pixels of eight may lie beyond the cell, and must not read beyond the frame.
    const int lastTexel = frame.rowPixels * (frame.height - 2) + frame.width - 2;
    const __m256i last = _mm256_set1_epi32(lastTexel);
    __m256i u = _mm256_add_epi32(_mm256_set1_epi32(s), _mm256_mullo_epi32(steps, _mm256_set1_epi32(ds)));
    __m256i v = _mm256_add_epi32(_mm256_set1_epi32(t), _mm256_mullo_epi32(steps, _mm256_set1_epi32(dt)));
    const __m256i du = _mm256_set1_epi32(8 * ds), dv = _mm256_set1_epi32(8 * dt);
    const auto* pixels = reinterpret_cast<const long long*>(frame.pixels);
    for (int x = 0; x < count; x += 8, s += 8 * ds, t += 8 * dt) {
        const __m256i w = _mm256_and_si256(_mm256_srli_epi32(u, 8), _mm256_set1_epi32(0xff));
        const __m256i across =
            _mm256_or_si256(_mm256_slli_epi32(w, 8), _mm256_sub_epi32(_mm256_set1_epi32(0xff), w));
        const __m256i down = _mm256_srli_epi32(_mm256_and_si256(v, _mm256_set1_epi32(0xffff)), 1);
        const __m256i column = _mm256_srai_epi32(u, 16), row = _mm256_srai_epi32(v, 16);
        const int left = std::min(s, s + 7 * ds) >> 16, right = std::max(s, s + 7 * ds) >> 16;
        const int top = std::min(t, t + 7 * dt) >> 16, bottom = std::max(t, t + 7 * dt) >> 16;
        const int first = top * frame.rowPixels + left;
        __m256i eight;
        // Where the picture is larger than its map, eight pixels want few texels: those of two rows or three
        // are loaded whole. Else each pixel fetches its own.
        if (right - left <= 6 && bottom - top <= 1 && first >= 0 &&
            first + (bottom - top) * frame.rowPixels + 6 <= lastTexel) {
            const __m256i from = _mm256_sub_epi32(column, _mm256_set1_epi32(left));
            const __m256i beside = _mm256_add_epi32(from, one);
            const auto load = [&](int down_) SHOAL_AVX2 {
                return _mm256_xor_si256(
                    flip, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(
                              frame.pixels + 4 * (ptrdiff_t{first} + down_ * frame.rowPixels))));
            };
            __m256i above = load(0), below = load(1);
            __m256i aboveLeft = _mm256_permutevar8x32_epi32(above, from),
                    aboveRight = _mm256_permutevar8x32_epi32(above, beside),
                    belowLeft = _mm256_permutevar8x32_epi32(below, from),
                    belowRight = _mm256_permutevar8x32_epi32(below, beside);
            if (bottom != top) {
                const __m256i third = load(2), lower = _mm256_cmpgt_epi32(row, _mm256_set1_epi32(top));
                aboveLeft = _mm256_blendv_epi8(aboveLeft, belowLeft, lower);
                aboveRight = _mm256_blendv_epi8(aboveRight, belowRight, lower);
                belowLeft = _mm256_blendv_epi8(belowLeft, _mm256_permutevar8x32_epi32(third, from), lower);
                belowRight =
                    _mm256_blendv_epi8(belowRight, _mm256_permutevar8x32_epi32(third, beside), lower);
            }
            eight = _mm256_xor_si256(flip, mixed(aboveLeft, aboveRight, belowLeft, belowRight, across, down));
        } else {
            __m256i own = _mm256_add_epi32(_mm256_mullo_epi32(row, stride), column);
            own = _mm256_min_epi32(_mm256_max_epi32(own, _mm256_setzero_si256()), last);
            const __m256i under = _mm256_add_epi32(own, stride);
            const __m256i lower = mixed(_mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(own), 4),
                                        _mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(under), 4),
                                        _mm256_castsi256_si128(across), _mm256_castsi256_si128(down));
            const __m256i upper =
                mixed(_mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(own, 1), 4),
                      _mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(under, 1), 4),
                      _mm256_extracti128_si256(across, 1), _mm256_extracti128_si256(down, 1));
            const __m256i bytes = _mm256_xor_si256(_mm256_packs_epi16(lower, upper), flip);
            eight = _mm256_permute4x64_epi64(bytes, _MM_SHUFFLE(3, 1, 2, 0));
        }
        if (x + 8 <= count)
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + x), eight);
        else
            _mm256_maskstore_epi32(reinterpret_cast<int*>(out + x),
                                   _mm256_cmpgt_epi32(_mm256_set1_epi32(count - x), steps), eight);
        u = _mm256_add_epi32(u, du);
        v = _mm256_add_epi32(v, dv);
    }
}

#endif

} // namespace

bool canSampleFrames() {
#ifdef SHOAL_AVX2
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

bool isWithin(const CodedFrame& frame, const SampledCell& cell) {
    constexpr float kRounding = 1 / 64.0f; // of fixed steps, added up over a cell
    const glm::vec2 last = glm::vec2(cell.high - cell.low - 1);
    for (const glm::vec2 corner : {glm::vec2(0), glm::vec2(last.x, 0), glm::vec2(0, last.y), last}) {
        const glm::vec2 at = cell.first + corner.x * cell.right + corner.y * cell.up;
        if (!(at.x >= kRounding && at.x <= static_cast<float>(frame.width - 1) - kRounding)) return false;
        if (!(at.y >= kRounding && at.y <= static_cast<float>(frame.height - 1) - kRounding)) return false;
    }
    return true;
}

void sampleCell(const CodedFrame& frame, const SampledCell& cell, uint32_t* picture, ptrdiff_t stride) {
    assert(canSampleFrames() && isWithin(frame, cell));
#ifdef SHOAL_AVX2
    const int ds = fixed(cell.right.x), dt = fixed(cell.right.y);
    for (int y = cell.low.y; y < cell.high.y; ++y) {
        const glm::vec2 at = cell.first + static_cast<float>(y - cell.low.y) * cell.up;
        sampleRow(frame, fixed(at.x), fixed(at.y), ds, dt, cell.high.x - cell.low.x,
                  picture + y * stride + cell.low.x);
    }
#else
    (void)frame, (void)cell, (void)picture, (void)stride;
#endif
}

} // namespace shoal::render
