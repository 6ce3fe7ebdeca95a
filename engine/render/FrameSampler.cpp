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

// s, t: of the first pixel, in fixed texels from the frame's first; ds, dt: from pixel to pixel.
SHOAL_AVX2
void sampleRow(const CodedFrame& frame, int s, int t, int ds, int dt, int count, uint32_t* out) {
    const __m256i steps = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i stride = _mm256_set1_epi32(frame.rowPixels);
    // The last pixels of eight may lie beyond the cell, and must not read beyond the frame.
    const __m256i last = _mm256_set1_epi32(frame.rowPixels * (frame.height - 2) + frame.width - 2);
    __m256i u = _mm256_add_epi32(_mm256_set1_epi32(s), _mm256_mullo_epi32(steps, _mm256_set1_epi32(ds)));
    __m256i v = _mm256_add_epi32(_mm256_set1_epi32(t), _mm256_mullo_epi32(steps, _mm256_set1_epi32(dt)));
    const __m256i du = _mm256_set1_epi32(8 * ds), dv = _mm256_set1_epi32(8 * dt);
    const auto* pixels = reinterpret_cast<const long long*>(frame.pixels);
    for (int x = 0; x < count; x += 8) {
        __m256i first =
            _mm256_add_epi32(_mm256_mullo_epi32(_mm256_srai_epi32(v, 16), stride), _mm256_srai_epi32(u, 16));
        first = _mm256_min_epi32(_mm256_max_epi32(first, _mm256_setzero_si256()), last);
        const __m256i below = _mm256_add_epi32(first, stride);
        const __m256i w = _mm256_and_si256(_mm256_srli_epi32(u, 8), _mm256_set1_epi32(0xff));
        const __m256i across =
            _mm256_or_si256(_mm256_slli_epi32(w, 8), _mm256_sub_epi32(_mm256_set1_epi32(0xff), w));
        const __m256i down = _mm256_srli_epi32(_mm256_and_si256(v, _mm256_set1_epi32(0xffff)), 1);
        const __m256i left = mixed(_mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(first), 4),
                                   _mm256_i32gather_epi64(pixels, _mm256_castsi256_si128(below), 4),
                                   _mm256_castsi256_si128(across), _mm256_castsi256_si128(down));
        const __m256i right = mixed(_mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(first, 1), 4),
                                    _mm256_i32gather_epi64(pixels, _mm256_extracti128_si256(below, 1), 4),
                                    _mm256_extracti128_si256(across, 1), _mm256_extracti128_si256(down, 1));
        const __m256i bytes =
            _mm256_xor_si256(_mm256_packs_epi16(left, right), _mm256_set1_epi8(static_cast<char>(0x80)));
        const __m256i eight = _mm256_permute4x64_epi64(bytes, _MM_SHUFFLE(3, 1, 2, 0));
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
