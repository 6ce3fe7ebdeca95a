#include "engine/light/BlockMeans.h"

#include <algorithm>
#include <array>
#include <cassert>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2")))
#define SHOAL_AVX512 __attribute__((target("avx512f,avx512bw,avx512vl,avx512vbmi,avx512vnni")))
#endif

namespace shoal::light {

namespace {

constexpr int kBlock = 4;

// What every loop computes, in whole numbers:
//     l = 30 red + 59 green + 11 blue,  x = 2 l / 2^16
//     scale = kPlain + 4 * 2^16 x^10  (each product cut to a whole number)
//     sum += (scale * weight + 2^14) / 2^15 * colour
// What the cuts take away from the tenth power is shared out by kUnit between bright and dark.
constexpr int kLumaRed = 30, kLumaGreen = 59, kLumaBlue = 11;
constexpr int kPlain = 3843;                   // 0.18 times the 4 * 2^16 (51000 / 2^16)^10 of white
constexpr float kUnit = 1.8f / 3842.6f;        // radiance of white for each 1 of scale
constexpr float kWeightUnit = 1.0f / 32768.0f; // of RowWeights

struct RowWeights {
    std::array<int16_t, kBlock> of; // 2^15 would be 1
    float unit = 0;                 // a sum's by the mean radiance

    explicit RowWeights(const float* weights) {
        const float maximum = *std::max_element(weights, weights + kBlock);
        float sum = 0;
        for (size_t y = 0; y < kBlock; ++y) {
            of[y] = static_cast<int16_t>(32767 * weights[y] / maximum + 0.5f);
            sum += static_cast<float>(of[y]) * kWeightUnit;
        }
        unit = kUnit / (255 * kBlock * sum);
    }
};

// A row of blocks; stride: bytes from one row of pixels to the next.
struct BlockRow {
    const uint8_t* pixels = nullptr;
    ptrdiff_t stride = 0;
    bool bgr = true;
    RowWeights weights;
};

uint16_t upperHalf(uint16_t a, uint16_t b) { return static_cast<uint16_t>(uint32_t{a} * b >> 16); }

void meansPlain(const BlockRow& row, int first, int end, float* out) {
    const int redAt = row.bgr ? 2 : 0, blueAt = 2 - redAt;
    for (int x = first; x < end; ++x) {
        std::array<int32_t, 3> sums{};
        for (int y = 0; y < kBlock; ++y) {
            const uint8_t* p = row.pixels + y * row.stride + 3 * kBlock * x;
            for (int i = 0; i < kBlock; ++i, p += 3) {
                const int red = p[redAt], green = p[1], blue = p[blueAt];
                const auto l =
                    static_cast<uint16_t>(2 * (kLumaRed * red + kLumaGreen * green + kLumaBlue * blue));
                const uint16_t l2 = upperHalf(l, l), l4 = static_cast<uint16_t>(2 * upperHalf(l2, l2)),
                               l8 = upperHalf(l4, l4);
                const int scale = kPlain + upperHalf(l8, l2);
                const int share = (scale * row.weights.of[static_cast<size_t>(y)] + (1 << 14)) >> 15;
                sums[0] += share * red;
                sums[1] += share * green;
                sums[2] += share * blue;
            }
        }
        for (size_t c = 0; c < 3; ++c)
            out[3 * static_cast<size_t>(x) + c] = static_cast<float>(sums[c]) * row.weights.unit;
    }
}

#ifdef SHOAL_AVX2

constexpr short kLumaBlueGreen = kLumaGreen << 8 | kLumaBlue;

SHOAL_AVX2 inline __m256i twoHalves(const uint8_t* low, const uint8_t* high) {
    return _mm256_inserti128_si256(
        _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(low))),
        _mm_loadu_si128(reinterpret_cast<const __m128i*>(high)), 1);
}

// Of the four pixels from byte `first` on: blue and green in turn, then red and nothing in turn.
__m128i blueGreenThenRed(int first, bool bgr) {
    std::array<char, 16> pick;
    for (size_t i = 0; i < 4; ++i) {
        const int pixel = first + 3 * static_cast<int>(i);
        pick[2 * i] = static_cast<char>(pixel + (bgr ? 0 : 2));
        pick[2 * i + 1] = static_cast<char>(pixel + 1);
        pick[8 + 2 * i] = static_cast<char>(pixel + (bgr ? 2 : 0));
        pick[8 + 2 * i + 1] = -1;
    }
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(pick.data()));
}

// Blocks 0 .. count - 1, a multiple of 4: four at a time, a quarter of a register each.
SHOAL_AVX2
void meansAvx2(const BlockRow& row, int count, float* out) {
    const __m256i pickFirst = _mm256_broadcastsi128_si256(blueGreenThenRed(0, row.bgr));
    // The fourth block is read with what lies before it: nothing beyond the row is touched.
    const __m256i pickSecond = _mm256_inserti128_si256(pickFirst, blueGreenThenRed(4, row.bgr), 1);
    const __m256i lumaBlueGreen = _mm256_set1_epi16(kLumaBlueGreen), lumaRed = _mm256_set1_epi16(kLumaRed);
    const __m256i lowByte = _mm256_set1_epi16(0xff), plain = _mm256_set1_epi16(kPlain);
    const __m256 unit = _mm256_set1_ps(row.weights.unit);
    for (int x = 0; x < count; x += 4) {
        __m256i sumRed = _mm256_setzero_si256(), sumGreen = sumRed, sumBlue = sumRed;
        const uint8_t* p = row.pixels + 12 * x;
        for (size_t y = 0; y < kBlock; ++y, p += row.stride) {
            const __m256i even = _mm256_shuffle_epi8(twoHalves(p, p + 24), pickFirst);
            const __m256i odd = _mm256_shuffle_epi8(twoHalves(p + 12, p + 32), pickSecond);
            const __m256i blueGreen = _mm256_unpacklo_epi64(even, odd);
            const __m256i red = _mm256_unpackhi_epi64(even, odd);
            const __m256i green = _mm256_srli_epi16(blueGreen, 8);
            const __m256i blue = _mm256_and_si256(blueGreen, lowByte);
            __m256i l = _mm256_add_epi16(_mm256_maddubs_epi16(blueGreen, lumaBlueGreen),
                                         _mm256_mullo_epi16(red, lumaRed));
            l = _mm256_add_epi16(l, l);
            const __m256i l2 = _mm256_mulhi_epu16(l, l);
            __m256i l4 = _mm256_mulhi_epu16(l2, l2);
            l4 = _mm256_add_epi16(l4, l4);
            const __m256i l8 = _mm256_mulhi_epu16(l4, l4);
            const __m256i scale = _mm256_add_epi16(_mm256_mulhi_epu16(l8, l2), plain);
            const __m256i share = _mm256_mulhrs_epi16(scale, _mm256_set1_epi16(row.weights.of[y]));
            sumRed = _mm256_add_epi32(sumRed, _mm256_madd_epi16(share, red));
            sumGreen = _mm256_add_epi32(sumGreen, _mm256_madd_epi16(share, green));
            sumBlue = _mm256_add_epi32(sumBlue, _mm256_madd_epi16(share, blue));
        }
        alignas(32) std::array<float, 8> redGreen, blues; // red, red, green, green; blue, blue, ..
        _mm256_store_ps(redGreen.data(),
                        _mm256_mul_ps(unit, _mm256_cvtepi32_ps(_mm256_hadd_epi32(sumRed, sumGreen))));
        _mm256_store_ps(blues.data(),
                        _mm256_mul_ps(unit, _mm256_cvtepi32_ps(_mm256_hadd_epi32(sumBlue, sumBlue))));
        float* to = out + 3 * x;
        for (size_t block = 0; block < 4; ++block, to += 3) {
            const size_t at = block / 2 * 4 + block % 2;
            to[0] = redGreen[at];
            to[1] = redGreen[at + 2];
            to[2] = blues[at];
        }
    }
}

// Where 32 pixels' bytes lie in two registers, from byte `first` on: the first halves of all blocks, then the
// second.
struct Picks512 {
    alignas(64) std::array<uint8_t, 64> blueGreen{}, red{};

    constexpr Picks512(size_t first, bool bgr) {
        for (size_t i = 0; i < 32; ++i) {
            const size_t pixel = first + 3 * (i % 16 / 2 * 4 + i / 16 * 2 + i % 2);
            blueGreen[2 * i] = static_cast<uint8_t>(pixel + (bgr ? 0 : 2));
            blueGreen[2 * i + 1] = static_cast<uint8_t>(pixel + 1);
            red[2 * i] = static_cast<uint8_t>(pixel + (bgr ? 2 : 0));
        }
    }
};
constexpr std::array<Picks512, 2> kPicksRgb = {Picks512(0, false), Picks512(32, false)};
constexpr std::array<Picks512, 2> kPicksBgr = {Picks512(0, true), Picks512(32, true)};

// Of eight blocks, in halves.
struct Sums512 {
    __m512i red, green, blue;
};

// Eight blocks from `pixels` on, of which the picks are made in the bytes from `pixels` and from 64 further
// on. All rows take each step together: what waits for a product waits beside what does not.
SHOAL_AVX512
inline void sumOf(const uint8_t* pixels, ptrdiff_t stride, const Picks512& picks, const __m512i* weights,
                  Sums512& sums) {
    __m512i blueGreen[kBlock], red[kBlock], l[kBlock], l2[kBlock], power[kBlock];
    for (size_t y = 0; y < kBlock; ++y, pixels += stride) {
        const __m512i low = _mm512_loadu_si512(pixels), high = _mm512_loadu_si512(pixels + 64);
        blueGreen[y] = _mm512_permutex2var_epi8(low, _mm512_load_si512(picks.blueGreen.data()), high);
        red[y] = _mm512_maskz_permutex2var_epi8(0x5555555555555555, low, _mm512_load_si512(picks.red.data()),
                                                high);
    }
    for (size_t y = 0; y < kBlock; ++y)
        l[y] = _mm512_add_epi16(_mm512_maddubs_epi16(blueGreen[y], _mm512_set1_epi16(kLumaBlueGreen)),
                                _mm512_maddubs_epi16(red[y], _mm512_set1_epi16(kLumaRed)));
    for (size_t y = 0; y < kBlock; ++y) l[y] = _mm512_add_epi16(l[y], l[y]);
    for (size_t y = 0; y < kBlock; ++y) l2[y] = _mm512_mulhi_epu16(l[y], l[y]);
    for (size_t y = 0; y < kBlock; ++y) power[y] = _mm512_mulhi_epu16(l2[y], l2[y]);
    for (size_t y = 0; y < kBlock; ++y) power[y] = _mm512_add_epi16(power[y], power[y]);
    for (size_t y = 0; y < kBlock; ++y) power[y] = _mm512_mulhi_epu16(power[y], power[y]);
    for (size_t y = 0; y < kBlock; ++y) power[y] = _mm512_mulhi_epu16(power[y], l2[y]);
    for (size_t y = 0; y < kBlock; ++y)
        power[y] = _mm512_mulhrs_epi16(_mm512_add_epi16(power[y], _mm512_set1_epi16(kPlain)), weights[y]);
    sums.red = sums.green = sums.blue = _mm512_setzero_si512();
    for (size_t y = 0; y < kBlock; ++y) {
        sums.red = _mm512_dpwssd_epi32(sums.red, power[y], red[y]);
        sums.green = _mm512_dpwssd_epi32(sums.green, power[y], _mm512_srli_epi16(blueGreen[y], 8));
        sums.blue =
            _mm512_dpwssd_epi32(sums.blue, power[y], _mm512_and_si512(blueGreen[y], _mm512_set1_epi16(0xff)));
    }
}

SHOAL_AVX512
inline void store(const Sums512& sums, float unit, float* out) {
    const __m256i red = _mm256_add_epi32(_mm512_castsi512_si256(sums.red),
                                         _mm512_extracti64x4_epi64(sums.red, 1)),
                  green = _mm256_add_epi32(_mm512_castsi512_si256(sums.green),
                                           _mm512_extracti64x4_epi64(sums.green, 1)),
                  blue = _mm256_add_epi32(_mm512_castsi512_si256(sums.blue),
                                          _mm512_extracti64x4_epi64(sums.blue, 1));
    const __m512 redGreen = _mm512_mul_ps(
        _mm512_set1_ps(unit), _mm512_cvtepi32_ps(_mm512_inserti64x4(_mm512_castsi256_si512(red), green, 1)));
    const __m512 blues =
        _mm512_mul_ps(_mm512_set1_ps(unit), _mm512_cvtepi32_ps(_mm512_castsi256_si512(blue)));
    // Red of 8 blocks and their green, then their blue: interleaved.
    const __m512i first = _mm512_setr_epi32(0, 8, 16, 1, 9, 17, 2, 10, 18, 3, 11, 19, 4, 12, 20, 5);
    const __m512i last = _mm512_setr_epi32(13, 21, 6, 14, 22, 7, 15, 23, 0, 0, 0, 0, 0, 0, 0, 0);
    _mm512_storeu_ps(out, _mm512_permutex2var_ps(redGreen, first, blues));
    _mm256_storeu_ps(out + 16, _mm512_castps512_ps256(_mm512_permutex2var_ps(redGreen, last, blues)));
}

// Blocks 0 .. count - 1, a multiple of 16.
SHOAL_AVX512
void meansAvx512(const BlockRow& row, int count, float* out) {
    const std::array<Picks512, 2>& picks = row.bgr ? kPicksBgr : kPicksRgb;
    __m512i weights[kBlock];
    for (size_t y = 0; y < kBlock; ++y) weights[y] = _mm512_set1_epi16(row.weights.of[y]);
    for (int x = 0; x < count; x += 16) {
        Sums512 sums;
        const uint8_t* pixels = row.pixels + 12 * x;
        sumOf(pixels, row.stride, picks[0], weights, sums);
        store(sums, row.weights.unit, out + 3 * x);
        sumOf(pixels + 64, row.stride, picks[1], weights, sums);
        store(sums, row.weights.unit, out + 3 * x + 24);
    }
}

#endif

} // namespace

bool canRun(BlockLoop loop) {
#ifdef SHOAL_AVX2
    if (loop == BlockLoop::Avx2) return __builtin_cpu_supports("avx2");
    if (loop == BlockLoop::Avx512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi") &&
               __builtin_cpu_supports("avx512vnni");
#endif
    return loop == BlockLoop::Plain;
}

BlockLoop fastestBlockLoop() {
    return canRun(BlockLoop::Avx512) ? BlockLoop::Avx512
           : canRun(BlockLoop::Avx2) ? BlockLoop::Avx2
                                     : BlockLoop::Plain;
}

void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out,
                    BlockLoop loop) {
    assert(frame.width % kBlock == 0 && frame.height % kBlock == 0 && out.width == frame.width / kBlock &&
           out.height == frame.height / kBlock && rowWeights.size() == static_cast<size_t>(frame.height));
    assert(canRun(loop));
    for (int y = 0; y < out.height; ++y) {
        const BlockRow row{frame.pixels + kBlock * y * frame.rowStride, frame.rowStride, frame.bgr,
                           RowWeights(rowWeights.data() + kBlock * y)};
        int x = 0;
#ifdef SHOAL_AVX2
        if (loop == BlockLoop::Avx512) meansAvx512(row, x = out.width & ~15, out.at(0, y));
        if (loop == BlockLoop::Avx2) meansAvx2(row, x = out.width & ~3, out.at(0, y));
#endif
        meansPlain(row, x, out.width, out.at(0, y));
    }
}

} // namespace shoal::light
