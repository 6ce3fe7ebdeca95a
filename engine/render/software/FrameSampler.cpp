#include "engine/render/software/FrameSampler.h"

#include "engine/core/Vectorise.h"

#include <algorithm>
#include <cassert>

namespace shoal::render {

namespace {

constexpr float kOne = 65536; // fixed point

// This code uses intrinsics because Highway 1.0 has no product of unsigned with signed bytes (maddubs), and
// 16-bit products take 1.17 to 1.23 times as long.
#ifdef SHOAL_AVX2

int fixed(float texels) { return _mm_cvtss_si32(_mm_set_ss(texels * kOne)); }

// Mixes texels by places in fixed point, whose low 16 bits are the weight between two texels. Texels come as
// bytes less 128, neighbours side by side, and are mixed as 16-bit numbers of 127.5 times their value, which
// just fit. Weights across have 8 bits (255 - w and w), weights down have 15.
SHOAL_AVX2
__m256i mixedRows(__m256i above, __m256i below, __m256i across, __m256i down) {
    const __m256i w = _mm256_xor_si256(across, _mm256_set1_epi16(0x00ff)), h = _mm256_srli_epi16(down, 1);
    const __m256i a = _mm256_srai_epi16(_mm256_maddubs_epi16(w, above), 1);
    const __m256i b = _mm256_srai_epi16(_mm256_maddubs_epi16(w, below), 1);
    const __m256i sum = _mm256_add_epi16(a, _mm256_mulhrs_epi16(_mm256_sub_epi16(b, a), h));
    return _mm256_mulhrs_epi16(sum, _mm256_set1_epi16(257)); // 2^15 / 127.5
}

// Copies the bytes of two pixels' places to their four channels, in each half of a register.
SHOAL_AVX2
__m256i forChannels(__m256i places, int low, int high, int next) {
    const auto four = [](int at, int above) { return (at | above << 8) * 0x0001000100010001ll; };
    return _mm256_shuffle_epi8(
        places, _mm256_broadcastsi128_si256(_mm_set_epi64x(four(low + next, high + next), four(low, high))));
}

// Mixes four pixels whose texels lie in pairs, of one row and of the next.
SHOAL_AVX2
__m256i mixed(__m256i above, __m256i below, __m128i u, __m128i v) {
    const __m256i pairUp =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 4, 1, 5, 2, 6, 3, 7, 8, 12, 9, 13, 10, 14, 11, 15));
    const __m256i flip = _mm256_set1_epi8(static_cast<char>(0x80));
    return mixedRows(_mm256_shuffle_epi8(_mm256_xor_si256(above, flip), pairUp),
                     _mm256_shuffle_epi8(_mm256_xor_si256(below, flip), pairUp),
                     forChannels(_mm256_cvtepu32_epi64(u), 1, 1, 8),
                     forChannels(_mm256_cvtepu32_epi64(v), 0, 1, 8));
}

// Mixes eight pixels whose left and right texels, less 128, lie apart.
SHOAL_AVX2
__m256i mixed(__m256i aboveLeft, __m256i aboveRight, __m256i belowLeft, __m256i belowRight, __m256i u,
              __m256i v) {
    const __m256i first =
        mixedRows(_mm256_unpacklo_epi8(aboveLeft, aboveRight), _mm256_unpacklo_epi8(belowLeft, belowRight),
                  forChannels(u, 1, 1, 4), forChannels(v, 0, 1, 4));
    const __m256i second =
        mixedRows(_mm256_unpackhi_epi8(aboveLeft, aboveRight), _mm256_unpackhi_epi8(belowLeft, belowRight),
                  forChannels(u, 9, 9, 4), forChannels(v, 8, 9, 4));
    return _mm256_packs_epi16(first, second);
}

// Samples a row of pixels. s, t: of the first pixel, in fixed-point texels from the frame's first; ds, dt:
// steps. Both ways of loading are in one function: they share a dozen registers that a call would spill.
SHOAL_AVX2
void sampleRow(const DisplayFrame& frame, int s, int t, int ds, int dt, int count, uint32_t* out) {
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
    // Offsets of the outermost of eight pixels from the first.
    const int leftmost = std::min(0, 7 * ds), rightmost = std::max(0, 7 * ds);
    const int topmost = std::min(0, 7 * dt), lowest = std::max(0, 7 * dt);
    for (int x = 0; x < count; x += 8, s += 8 * ds, t += 8 * dt) {
        const __m256i column = _mm256_srai_epi32(u, 16), row = _mm256_srai_epi32(v, 16);
        const int left = (s + leftmost) >> 16, right = (s + rightmost) >> 16;
        const int top = (t + topmost) >> 16, bottom = (t + lowest) >> 16;
        const int first = top * frame.rowPixels + left;
        __m256i eight;
        // If the picture is larger than its map, eight pixels need few texels: eight texels each of two or
        // three rows are loaded at once. Otherwise each pixel fetches its own texels.
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
            eight = _mm256_xor_si256(flip, mixed(aboveLeft, aboveRight, belowLeft, belowRight, u, v));
        } else {
            __m256i own = _mm256_add_epi32(_mm256_mullo_epi32(row, stride), column);
            own = _mm256_min_epi32(_mm256_max_epi32(own, _mm256_setzero_si256()), last);
            const __m256i under = _mm256_add_epi32(own, stride);
            const __m256i lower = mixed(_mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(own), 4),
                                        _mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(under), 4),
                                        _mm256_castsi256_si128(u), _mm256_castsi256_si128(v));
            const __m256i upper = mixed(_mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(own, 1), 4),
                                        _mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(under, 1), 4),
                                        _mm256_extracti128_si256(u, 1), _mm256_extracti128_si256(v, 1));
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

bool isWithin(const DisplayFrame& frame, const SampledCell& cell) {
    constexpr float kRounding = 1 / 64.0f; // error of fixed-point steps, summed over a cell
    const glm::vec2 last = glm::vec2(cell.high - cell.low - 1);
    for (const glm::vec2 corner : {glm::vec2(0), glm::vec2(last.x, 0), glm::vec2(0, last.y), last}) {
        const glm::vec2 at = cell.first + corner.x * cell.right + corner.y * cell.up;
        if (!(at.x >= kRounding && at.x <= static_cast<float>(frame.width - 1) - kRounding)) return false;
        if (!(at.y >= kRounding && at.y <= static_cast<float>(frame.height - 1) - kRounding)) return false;
    }
    return true;
}

void sampleCell(const DisplayFrame& frame, const SampledCell& cell, uint32_t* picture, ptrdiff_t stride) {
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
