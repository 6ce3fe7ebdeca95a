#include "engine/light/BlockMeans.h"

#include "engine/light/InverseToneMap.h"

#include <array>
#include <cassert>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2,fma")))
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

// Two blocks side by side at a time, one in each half of a register: 12 bytes a row become three registers
// of 4 + 4 floats. Reads 4 bytes past a pair of blocks and writes one float past its two texels, so the last
// pair of a row is not for it: `blocks` is even, and two more follow.
SHOAL_AVX2
void meansOfRow(const uint8_t* pixels, ptrdiff_t stride, int blocks, const float* rowWeights, bool bgr,
                float* out) {
    const auto everyThird = [](char first) {
        const char a = first, b = static_cast<char>(first + 3), c = static_cast<char>(first + 6),
                   d = static_cast<char>(first + 9);
        return _mm_setr_epi8(a, -1, -1, -1, b, -1, -1, -1, c, -1, -1, -1, d, -1, -1, -1);
    };
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
    for (int y = 0; y < out.height; ++y) {
        const uint8_t* pixels = frame.pixels + kBlock * y * frame.rowStride;
        const float* weights = rowWeights.data() + kBlock * y;
        int x = 0;
#ifdef SHOAL_AVX2
        if (out.width > 4) {
            x = (out.width - 2) & ~1;
            meansOfRow(pixels, frame.rowStride, x, weights, frame.bgr, out.at(0, y));
        }
#endif
        for (; x < out.width; ++x)
            meanOfBlock(pixels + 3 * kBlock * x, frame.rowStride, weights, frame.bgr, out.at(x, y));
    }
}

} // namespace shoal::light
