#include "engine/light/BlockMeans.h"

#include "engine/core/Vectorise.h"
#include "engine/light/ClippedLight.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace shoal::light {

namespace {

constexpr int kBlock = 4;

// All loops compute radiance as scale times coded value, in integers.
//
// The thesis' decoding has one scale for all channels:
//     l = 30 red + 59 green + 11 blue,  x = 2 l / 2^16
//     scale = kPlain + 4 * 2^16 x^10  (each product truncated to an integer)
// kThesisUnit compensates for the mean error of these truncations.
constexpr int kLumaRed = 30, kLumaGreen = 59, kLumaBlue = 11;
constexpr int kPlain = 3843;                  // 0.18 times the 4 * 2^16 (51000 / 2^16)^10 of white
constexpr float kThesisUnit = 1.8f / 3842.6f; // radiance of white for each 1 of scale

// The scale of sRGB is decoded over coded value. It rises by a factor of twelve from black to white and is
// nearly linear over any sixteenth of the coded values:
//     scale = kStart[coded / 16] + kSlope[coded / 16] * (coded % 16)
// These lines minimise the largest error relative to a tolerance: from coded 10 on 2e-4 of white or 1 %,
// whichever is stricter, below that 9 %. White is exact.
constexpr std::array<uint16_t, 16> kStart = {2295,  2596,  3637,  4966,  6466,  8098,  9845,  11688,
                                             13630, 15654, 17756, 19933, 22186, 24507, 26893, 29342};
constexpr std::array<uint8_t, 16> kSlope = {17,  63,  83,  94,  102, 109, 115, 121,
                                            126, 131, 136, 141, 145, 149, 153, 157};
constexpr float kLinearUnit = 1 / (29342.0f + 15 * 157);

constexpr std::array<int16_t, 256> kScaleOfSrgb = [] {
    std::array<int16_t, 256> scales{};
    for (int coded = 0; coded < 256; ++coded)
        scales[coded] = static_cast<int16_t>(kStart[coded / 16] + kSlope[coded / 16] * (coded % 16));
    return scales;
}();

// A row of blocks.
struct BlockRow {
    const uint8_t* pixels = nullptr;
    ptrdiff_t stride = 0; // bytes from one row of pixels to the next
    bool bgr = true;
    float* out = nullptr;
    float* clipped = nullptr;
    std::array<int16_t, kBlock> weights{}, clippedWeights{}; // in units of 2^-15
    float unit = 0, clippedUnit = 0;                         // factor from sum to mean

    // Sets weights and units. unitOfOne: radiance of white for each 1 of scale.
    void weigh(const float* rows, float unitOfOne) {
        const float maximum = *std::max_element(rows, rows + kBlock);
        float sum = 0;
        for (size_t y = 0; y < kBlock; ++y) {
            weights[y] = static_cast<int16_t>(32767 * rows[y] / maximum + 0.5f);
            sum += static_cast<float>(weights[y]);
        }
        unit = unitOfOne * 32768.0f / (255 * kBlock * sum);
        clippedUnit = 1 / (kClippedSteps * kBlock * sum);
    }

    // Sets clippedWeights, after weigh(). Returns whether one is above 0.
    bool weighClipped(const float* shares) {
        for (size_t y = 0; y < kBlock; ++y)
            clippedWeights[y] = static_cast<int16_t>(static_cast<float>(weights[y]) * shares[y] + 0.5f);
        return clippedWeights != std::array<int16_t, kBlock>{};
    }
};

uint16_t upperHalf(uint16_t a, uint16_t b) { return static_cast<uint16_t>(uint32_t{a} * b >> 16); }

int thesisScale(int red, int green, int blue) {
    const auto l = static_cast<uint16_t>(2 * (kLumaRed * red + kLumaGreen * green + kLumaBlue * blue));
    const uint16_t l2 = upperHalf(l, l), l4 = static_cast<uint16_t>(2 * upperHalf(l2, l2)),
                   l8 = upperHalf(l4, l4);
    return kPlain + upperHalf(l8, l2);
}

template <FrameRadiance kFrom> void meansPlain(const BlockRow& row, int first, int end) {
    const std::array<size_t, 3> channels = {row.bgr ? 2u : 0u, 1u, row.bgr ? 0u : 2u};
    for (int x = first; x < end; ++x) {
        std::array<int32_t, 3> sums{};
        int32_t clipped = 0;
        for (int y = 0; y < kBlock; ++y) {
            const uint8_t* p = row.pixels + y * row.stride + 3 * kBlock * x;
            for (int i = 0; i < kBlock; ++i, p += 3) {
                const int thesis =
                    kFrom == FrameRadiance::Thesis ? thesisScale(p[channels[0]], p[1], p[channels[2]]) : 0;
                for (size_t c = 0; c < 3; ++c) {
                    const int colour = p[channels[c]];
                    const int scale = kFrom == FrameRadiance::Thesis ? thesis : kScaleOfSrgb[colour];
                    sums[c] += ((scale * row.weights[y] + (1 << 14)) >> 15) * colour;
                }
                if (kFrom == FrameRadiance::Auto) clipped += clippedSteps(p) * row.clippedWeights[y];
            }
        }
        for (size_t c = 0; c < 3; ++c)
            row.out[3 * static_cast<size_t>(x) + c] = static_cast<float>(sums[c]) * row.unit;
        if (kFrom == FrameRadiance::Auto) row.clipped[x] = static_cast<float>(clipped) * row.clippedUnit;
    }
}

#ifdef SHOAL_AVX2

SHOAL_AVX2 inline __m256i twoHalves(const uint8_t* low, const uint8_t* high) {
    return _mm256_loadu2_m128i(reinterpret_cast<const __m128i*>(high), reinterpret_cast<const __m128i*>(low));
}

// Returns the shuffle mask that sorts four pixels from byte `first` on: all red, all green, all blue.
__m128i planesOf(int first, bool bgr) {
    std::array<char, 16> pick;
    pick.fill(-1);
    for (size_t i = 0; i < 4; ++i) {
        const int pixel = first + 3 * static_cast<int>(i);
        pick[i] = static_cast<char>(pixel + (bgr ? 2 : 0));
        pick[4 + i] = static_cast<char>(pixel + 1);
        pick[8 + i] = static_cast<char>(pixel + (bgr ? 0 : 2));
    }
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(pick.data()));
}

// Two rows of pixels of four blocks. Each half of a register holds two blocks of the upper row, then the same
// blocks of the lower row.
struct TwoRows {
    __m256i red, green, blue;
};

struct Picks {
    __m256i first, second;
};

SHOAL_AVX2 inline TwoRows readTwoRows(const uint8_t* p, ptrdiff_t stride, const Picks& picks) {
    // The fourth block is read together with the bytes before it, so that no byte beyond the row is read.
    const __m256i even = _mm256_shuffle_epi8(twoHalves(p, p + 24), picks.first);
    const __m256i odd = _mm256_shuffle_epi8(twoHalves(p + 12, p + 32), picks.second);
    p += stride;
    const __m256i evenBelow = _mm256_shuffle_epi8(twoHalves(p, p + 24), picks.first);
    const __m256i oddBelow = _mm256_shuffle_epi8(twoHalves(p + 12, p + 32), picks.second);
    const __m256i redGreen = _mm256_unpacklo_epi32(even, odd), blue = _mm256_unpackhi_epi32(even, odd);
    const __m256i redGreenBelow = _mm256_unpacklo_epi32(evenBelow, oddBelow),
                  blueBelow = _mm256_unpackhi_epi32(evenBelow, oddBelow);
    return {_mm256_unpacklo_epi64(redGreen, redGreenBelow), _mm256_unpackhi_epi64(redGreen, redGreenBelow),
            _mm256_unpacklo_epi64(blue, blueBelow)};
}

// upper() and lower() widen the values of the upper and of the lower row to 16 bits.
SHOAL_AVX2 inline __m256i upper(__m256i bytes) { return _mm256_unpacklo_epi8(bytes, _mm256_setzero_si256()); }
SHOAL_AVX2 inline __m256i lower(__m256i bytes) { return _mm256_unpackhi_epi8(bytes, _mm256_setzero_si256()); }

SHOAL_AVX2 inline void addWeighed(__m256i scale, __m256i weight, __m256i colour, __m256i& sum) {
    sum = _mm256_add_epi32(sum, _mm256_madd_epi16(_mm256_mulhrs_epi16(scale, weight), colour));
}

struct Sums {
    __m256i red, green, blue, clipped;
};

// blueGreen: bytes of blue and green in turn.
SHOAL_AVX2 inline void addThesis(__m256i red, __m256i blueGreen, __m256i weight, Sums& sums) {
    const __m256i green = _mm256_srli_epi16(blueGreen, 8);
    const __m256i blue = _mm256_and_si256(blueGreen, _mm256_set1_epi16(0xff));
    __m256i l =
        _mm256_add_epi16(_mm256_maddubs_epi16(blueGreen, _mm256_set1_epi16(kLumaGreen << 8 | kLumaBlue)),
                         _mm256_mullo_epi16(red, _mm256_set1_epi16(kLumaRed)));
    l = _mm256_add_epi16(l, l);
    const __m256i l2 = _mm256_mulhi_epu16(l, l);
    __m256i l4 = _mm256_mulhi_epu16(l2, l2);
    l4 = _mm256_add_epi16(l4, l4);
    const __m256i l8 = _mm256_mulhi_epu16(l4, l4);
    const __m256i scale = _mm256_add_epi16(_mm256_mulhi_epu16(l8, l2), _mm256_set1_epi16(kPlain));
    const __m256i share = _mm256_mulhrs_epi16(scale, weight);
    sums.red = _mm256_add_epi32(sums.red, _mm256_madd_epi16(share, red));
    sums.green = _mm256_add_epi32(sums.green, _mm256_madd_epi16(share, green));
    sums.blue = _mm256_add_epi32(sums.blue, _mm256_madd_epi16(share, blue));
}

// kStart as low and high bytes, and kSlope, each in both halves of a register.
struct Lines {
    __m256i low, high, slope;
};

SHOAL_AVX2 inline Lines makeLines() {
    std::array<uint8_t, 16> low, high;
    for (size_t i = 0; i < 16; ++i) {
        low[i] = static_cast<uint8_t>(kStart[i]);
        high[i] = static_cast<uint8_t>(kStart[i] >> 8);
    }
    return {twoHalves(low.data(), low.data()), twoHalves(high.data(), high.data()),
            twoHalves(kSlope.data(), kSlope.data())};
}

SHOAL_AVX2 inline void addLinear(__m256i coded, const Lines& lines, __m256i weight, __m256i weightBelow,
                                 __m256i& sum) {
    const __m256i four = _mm256_set1_epi8(15), one = _mm256_set1_epi8(1), zero = _mm256_setzero_si256();
    const __m256i line = _mm256_and_si256(_mm256_srli_epi16(coded, 4), four);
    const __m256i along = _mm256_and_si256(coded, four);
    const __m256i slope = _mm256_shuffle_epi8(lines.slope, line), low = _mm256_shuffle_epi8(lines.low, line),
                  high = _mm256_shuffle_epi8(lines.high, line);
    // slope * along + low * 1 + high * 2^8
    addWeighed(_mm256_add_epi16(
                   _mm256_maddubs_epi16(_mm256_unpacklo_epi8(slope, low), _mm256_unpacklo_epi8(along, one)),
                   _mm256_unpacklo_epi8(zero, high)),
               weight, upper(coded), sum);
    addWeighed(_mm256_add_epi16(
                   _mm256_maddubs_epi16(_mm256_unpackhi_epi8(slope, low), _mm256_unpackhi_epi8(along, one)),
                   _mm256_unpackhi_epi8(zero, high)),
               weightBelow, lower(coded), sum);
}

// clippedSteps() with AVX2.
SHOAL_AVX2 inline __m256i clippedStepsAvx2(const TwoRows& rows) {
    const __m256i last = _mm256_set1_epi8(static_cast<char>(kLastUnclipped));
    const __m256i low = _mm256_min_epu8(rows.red, rows.green), high = _mm256_max_epu8(rows.red, rows.green);
    const __m256i least = _mm256_subs_epu8(_mm256_min_epu8(low, rows.blue), last);
    const __m256i middle = _mm256_subs_epu8(_mm256_max_epu8(low, _mm256_min_epu8(high, rows.blue)), last);
    const __m256i twice = _mm256_add_epi8(least, least),
                  six = _mm256_add_epi8(twice, _mm256_add_epi8(twice, twice));
    return _mm256_add_epi8(_mm256_add_epi8(six, least), middle);
}

// Makes blocks 0 .. count - 1, four at a time; count: a multiple of 4.
template <FrameRadiance kFrom> SHOAL_AVX2 void meansAvx2(const BlockRow& row, int count) {
    const __m128i pick = planesOf(0, row.bgr);
    const Picks picks = {_mm256_broadcastsi128_si256(pick), _mm256_set_m128i(planesOf(4, row.bgr), pick)};
    const Lines lines = makeLines();
    const __m256 unit = _mm256_set1_ps(row.unit);
    for (int x = 0; x < count; x += 4) {
        Sums sums{};
        const uint8_t* p = row.pixels + 3 * kBlock * x;
        for (size_t y = 0; y < kBlock; y += 2, p += 2 * row.stride) {
            const TwoRows rows = readTwoRows(p, row.stride, picks);
            const __m256i weight = _mm256_set1_epi16(row.weights[y]),
                          weightBelow = _mm256_set1_epi16(row.weights[y + 1]);
            if (kFrom == FrameRadiance::Thesis) {
                addThesis(upper(rows.red), _mm256_unpacklo_epi8(rows.blue, rows.green), weight, sums);
                addThesis(lower(rows.red), _mm256_unpackhi_epi8(rows.blue, rows.green), weightBelow, sums);
                continue;
            }
            addLinear(rows.red, lines, weight, weightBelow, sums.red);
            addLinear(rows.green, lines, weight, weightBelow, sums.green);
            addLinear(rows.blue, lines, weight, weightBelow, sums.blue);
            if (kFrom == FrameRadiance::Linear) continue;
            const __m256i steps = clippedStepsAvx2(rows);
            sums.clipped = _mm256_add_epi32(
                sums.clipped,
                _mm256_add_epi32(
                    _mm256_madd_epi16(upper(steps), _mm256_set1_epi16(row.clippedWeights[y])),
                    _mm256_madd_epi16(lower(steps), _mm256_set1_epi16(row.clippedWeights[y + 1]))));
        }
        // Each half of redGreen holds red, red, green, green; of blues blue, blue, clipped, clipped.
        alignas(32) std::array<float, 8> redGreen, blues;
        _mm256_store_ps(redGreen.data(),
                        _mm256_mul_ps(unit, _mm256_cvtepi32_ps(_mm256_hadd_epi32(sums.red, sums.green))));
        const __m256 blue = _mm256_cvtepi32_ps(_mm256_hadd_epi32(sums.blue, sums.clipped));
        _mm256_store_ps(blues.data(),
                        _mm256_mul_ps(_mm256_setr_ps(row.unit, row.unit, row.clippedUnit, row.clippedUnit,
                                                     row.unit, row.unit, row.clippedUnit, row.clippedUnit),
                                      blue));
        float* to = row.out + 3 * x;
        for (size_t block = 0; block < 4; ++block, to += 3) {
            const size_t at = block / 2 * 4 + block % 2;
            to[0] = redGreen[at];
            to[1] = redGreen[at + 2];
            to[2] = blues[at];
            if (kFrom == FrameRadiance::Auto) row.clipped[static_cast<size_t>(x) + block] = blues[at + 2];
        }
    }
}

#endif

template <FrameRadiance kFrom> void means(const BlockRow& row, int width, [[maybe_unused]] BlockLoop loop) {
    int x = 0;
#ifdef SHOAL_AVX2
    if (loop == BlockLoop::Avx2) meansAvx2<kFrom>(row, x = width & ~3);
#endif
    meansPlain<kFrom>(row, x, width);
}

} // namespace

bool canRun(BlockLoop loop) {
#ifdef SHOAL_AVX2
    if (loop == BlockLoop::Avx2) return __builtin_cpu_supports("avx2");
#endif
    return loop == BlockLoop::Plain;
}

BlockLoop fastestBlockLoop() { return canRun(BlockLoop::Avx2) ? BlockLoop::Avx2 : BlockLoop::Plain; }

void makeBlockMeans(const FrameView& frame, FrameRadiance from, std::span<const float> rowWeights,
                    ImageRgbF& out, BlockLoop loop, std::span<const float> clippedWeights, ImageF* clipped) {
    assert(canRun(loop));
    assert(frame.width % kBlock == 0 && frame.height % kBlock == 0 && out.width == frame.width / kBlock &&
           out.height == frame.height / kBlock && rowWeights.size() == static_cast<size_t>(frame.height));
    assert(from != FrameRadiance::Auto || (clippedWeights.size() == rowWeights.size() &&
                                           clipped->width == out.width && clipped->height == out.height));
    for (int y = 0; y < out.height; ++y) {
        BlockRow row{frame.row(kBlock * y), frame.rowStride, frame.bgr, out.at(0, y)};
        row.weigh(rowWeights.data() + kBlock * y, from == FrameRadiance::Thesis ? kThesisUnit : kLinearUnit);
        if (from == FrameRadiance::Auto && row.weighClipped(clippedWeights.data() + kBlock * y)) {
            row.clipped = clipped->at(0, y);
            means<FrameRadiance::Auto>(row, out.width, loop);
        } else if (from == FrameRadiance::Thesis) {
            means<FrameRadiance::Thesis>(row, out.width, loop);
        } else {
            means<FrameRadiance::Linear>(row, out.width, loop);
        }
    }
}

} // namespace shoal::light
