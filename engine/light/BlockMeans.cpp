#include "engine/light/BlockMeans.h"

#include "engine/light/InverseToneMap.h"

#include <array>
#include <cassert>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2,fma")))
#define SHOAL_AVX512 __attribute__((target("avx512f,avx512bw")))
#endif

namespace shoal::light {

namespace {

constexpr int kBlock = 4;

// One block, for where no vectors serve.
void meanOfBlock(const uint8_t* pixels, ptrdiff_t stride, const float* rowWeights, bool bgr, float* out) {
    glm::vec3 sum(0);
    for (int y = 0; y < kBlock; ++y, pixels += stride)
        for (int x = 0; x < kBlock; ++x) {
            const uint8_t* p = pixels + 3 * x;
            const glm::vec3 coded = glm::vec3(p[bgr ? 2 : 0], p[1], p[bgr ? 0 : 2]) / 255.0f;
            sum += radianceFromDisplay(coded) * (rowWeights[y] / kBlock);
        }
    for (int c = 0; c < 3; ++c) out[c] = sum[c];
}

#ifdef SHOAL_AVX2

// Bytes first, first + 3, first + 6 and first + 9, each to an integer of its own.
__m128i everyThird(char first) {
    const char a = first, b = static_cast<char>(first + 3), c = static_cast<char>(first + 6),
               d = static_cast<char>(first + 9);
    return _mm_setr_epi8(a, -1, -1, -1, b, -1, -1, -1, c, -1, -1, -1, d, -1, -1, -1);
}

// Two blocks side by side at a time, one in each half of a register: 12 bytes a row become three registers
// of 4 + 4 floats. Reads 4 bytes past a pair of blocks and writes one float past its two texels, so the last
// pair of a row is not for it: `blocks` is even, and two more follow.
SHOAL_AVX2
void meansOfRow(const uint8_t* pixels, ptrdiff_t stride, int blocks, const float* rowWeights, bool bgr,
                float* out) {
    const __m256i pickRed = _mm256_broadcastsi128_si256(everyThird(bgr ? 2 : 0));
    const __m256i pickGreen = _mm256_broadcastsi128_si256(everyThird(1));
    const __m256i pickBlue = _mm256_broadcastsi128_si256(everyThird(bgr ? 0 : 2));
    const __m256 lumaRed = _mm256_set1_ps(0.30f / 255), lumaGreen = _mm256_set1_ps(0.59f / 255),
                 lumaBlue = _mm256_set1_ps(0.11f / 255);
    std::array<float, kBlock> bright, plain;
    for (size_t y = 0; y < kBlock; ++y) {
        const float share = rowWeights[y] / (255.0f * kBlock);
        bright[y] = 10.0f * share;
        plain[y] = 1.8f * share;
    }
    for (int x = 0; x < blocks; x += 2) {
        __m256 red = _mm256_setzero_ps(), green = red, blue = red;
        const uint8_t* p = pixels + 12 * x;
        for (size_t y = 0; y < kBlock; ++y, p += stride) {
            const __m256i bytes = _mm256_inserti128_si256(
                _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))),
                _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + 12)), 1);
            const __m256 r = _mm256_cvtepi32_ps(_mm256_shuffle_epi8(bytes, pickRed));
            const __m256 g = _mm256_cvtepi32_ps(_mm256_shuffle_epi8(bytes, pickGreen));
            const __m256 b = _mm256_cvtepi32_ps(_mm256_shuffle_epi8(bytes, pickBlue));
            const __m256 l =
                _mm256_fmadd_ps(lumaBlue, b, _mm256_fmadd_ps(lumaGreen, g, _mm256_mul_ps(lumaRed, r)));
            const __m256 l2 = _mm256_mul_ps(l, l);
            const __m256 l4 = _mm256_mul_ps(l2, l2);
            const __m256 l10 = _mm256_mul_ps(_mm256_mul_ps(l4, l4), l2);
            const __m256 scale = _mm256_fmadd_ps(l10, _mm256_set1_ps(bright[y]), _mm256_set1_ps(plain[y]));
            red = _mm256_fmadd_ps(scale, r, red);
            green = _mm256_fmadd_ps(scale, g, green);
            blue = _mm256_fmadd_ps(scale, b, blue);
        }
        const __m256 sums = _mm256_hadd_ps(_mm256_hadd_ps(red, green), _mm256_hadd_ps(blue, blue));
        _mm_storeu_ps(out + 3 * x, _mm256_castps256_ps128(sums));
        _mm_storeu_ps(out + 3 * x + 3, _mm256_extractf128_ps(sums, 1));
    }
}

// The same for four blocks side by side, one in each quarter of a register; reads and writes nothing beyond
// them. `blocks` is a multiple of 4.
SHOAL_AVX512
void meansOfRow512(const uint8_t* pixels, ptrdiff_t stride, int blocks, const float* rowWeights, bool bgr,
                   float* out) {
    constexpr __mmask16 kTwelve = 0x0fff;
    const __m512i toQuarters = _mm512_setr_epi32(0, 1, 2, 2, 3, 4, 5, 5, 6, 7, 8, 8, 9, 10, 11, 11);
    const __m512i toTexels = _mm512_setr_epi32(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 15, 15, 15, 15);
    const __m512i pickRed = _mm512_broadcast_i32x4(everyThird(bgr ? 2 : 0));
    const __m512i pickGreen = _mm512_broadcast_i32x4(everyThird(1));
    const __m512i pickBlue = _mm512_broadcast_i32x4(everyThird(bgr ? 0 : 2));
    const __m512 lumaRed = _mm512_set1_ps(0.30f / 255), lumaGreen = _mm512_set1_ps(0.59f / 255),
                 lumaBlue = _mm512_set1_ps(0.11f / 255);
    for (int x = 0; x < blocks; x += 4) {
        __m512 red = _mm512_setzero_ps(), green = red, blue = red;
        const uint8_t* p = pixels + 12 * x;
        for (size_t y = 0; y < kBlock; ++y, p += stride) {
            const float share = rowWeights[y] / (255.0f * kBlock);
            const __m512i bytes = _mm512_permutexvar_epi32(toQuarters, _mm512_maskz_loadu_epi32(kTwelve, p));
            const __m512 r = _mm512_cvtepi32_ps(_mm512_shuffle_epi8(bytes, pickRed));
            const __m512 g = _mm512_cvtepi32_ps(_mm512_shuffle_epi8(bytes, pickGreen));
            const __m512 b = _mm512_cvtepi32_ps(_mm512_shuffle_epi8(bytes, pickBlue));
            const __m512 l =
                _mm512_fmadd_ps(lumaBlue, b, _mm512_fmadd_ps(lumaGreen, g, _mm512_mul_ps(lumaRed, r)));
            const __m512 l2 = _mm512_mul_ps(l, l);
            const __m512 l4 = _mm512_mul_ps(l2, l2);
            const __m512 l10 = _mm512_mul_ps(_mm512_mul_ps(l4, l4), l2);
            const __m512 scale =
                _mm512_fmadd_ps(l10, _mm512_set1_ps(10.0f * share), _mm512_set1_ps(1.8f * share));
            red = _mm512_fmadd_ps(scale, r, red);
            green = _mm512_fmadd_ps(scale, g, green);
            blue = _mm512_fmadd_ps(scale, b, blue);
        }
        // Four sums in each quarter, of red and green together, then of all three.
        const __m512 none = _mm512_setzero_ps();
        const __m512 redGreen = _mm512_add_ps(_mm512_unpacklo_ps(red, green), _mm512_unpackhi_ps(red, green));
        const __m512 blueNone = _mm512_add_ps(_mm512_unpacklo_ps(blue, none), _mm512_unpackhi_ps(blue, none));
        const __m512 sums = _mm512_add_ps(_mm512_shuffle_ps(redGreen, blueNone, _MM_SHUFFLE(1, 0, 1, 0)),
                                          _mm512_shuffle_ps(redGreen, blueNone, _MM_SHUFFLE(3, 2, 3, 2)));
        _mm512_mask_storeu_ps(out + 3 * x, kTwelve, _mm512_permutexvar_ps(toTexels, sums));
    }
}

bool hasAvx512() { return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"); }

#endif

} // namespace

bool canMakeBlockMeans() {
#ifdef SHOAL_AVX2
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out) {
    assert(frame.width % kBlock == 0 && frame.height % kBlock == 0 && out.width == frame.width / kBlock &&
           out.height == frame.height / kBlock && rowWeights.size() == static_cast<size_t>(frame.height));
#ifdef SHOAL_AVX2
    const bool wide = hasAvx512();
#endif
    for (int y = 0; y < out.height; ++y) {
        const uint8_t* pixels = frame.pixels + kBlock * y * frame.rowStride;
        const float* weights = rowWeights.data() + kBlock * y;
        int x = 0;
#ifdef SHOAL_AVX2
        if (wide) {
            x = out.width & ~3;
            meansOfRow512(pixels, frame.rowStride, x, weights, frame.bgr, out.at(0, y));
        } else if (out.width > 4) {
            x = (out.width - 2) & ~1;
            meansOfRow(pixels, frame.rowStride, x, weights, frame.bgr, out.at(0, y));
        }
#endif
        for (; x < out.width; ++x)
            meanOfBlock(pixels + 3 * kBlock * x, frame.rowStride, weights, frame.bgr, out.at(x, y));
    }
}

} // namespace shoal::light
