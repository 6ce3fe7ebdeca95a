#include "engine/media/YuvToBgr.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2")))
#endif

namespace shoal::media {

namespace {

// Sums are in 1/32 of a level: 16 bits hold them, and rounding each product takes 1/64 at most.
constexpr int kSumBits = 5;
constexpr int kLumaBits = 7, kDifferenceBits = 8; // shifts that fill 16 bits before they are multiplied
constexpr int kMiddle = 128;                      // of differences

// The rounded product of two fractions of 2^15.
int product(int a, int b) { return (a * b + (1 << 14)) >> 15; }

uint8_t level(int sum) {
    return static_cast<uint8_t>(std::clamp((sum + (1 << (kSumBits - 1))) >> kSumBits, 0, 255));
}

} // namespace

Luma lumaOf(ColourMatrix matrix) {
    switch (matrix) {
    case ColourMatrix::Bt709:
        return {0.2126, 0.0722};
    case ColourMatrix::Bt2020:
        return {0.2627, 0.0593};
    case ColourMatrix::Bt601:
        break;
    }
    return {0.299, 0.114};
}

const char* nameOf(ColourMatrix matrix) {
    constexpr const char* kNames[] = {"BT.601", "BT.709", "BT.2020"};
    return kNames[static_cast<int>(matrix)];
}

ColourMatrix colourMatrixOf(int code, int width, int height) {
    if (code == 1) return ColourMatrix::Bt709;
    if (code == 5 || code == 6) return ColourMatrix::Bt601;
    if (code == 9) return ColourMatrix::Bt2020;
    return width >= 1280 || height > 576 ? ColourMatrix::Bt709 : ColourMatrix::Bt601;
}

bool runsHere(YuvLoop loop) {
#ifdef SHOAL_AVX2
    if (loop == YuvLoop::Avx2) return __builtin_cpu_supports("avx2");
#endif
    return loop == YuvLoop::Plain;
}

// With weights kr, kg, kb of luma and differences of +-1/2 (BT.601, BT.709 item 3):
//   R = Y + (2 - 2 kr) Cr,  B = Y + (2 - 2 kb) Cb,
//   G = (Y - kr R - kb B) / kg = Y - kb (2 - 2 kb) / kg Cb - kr (2 - 2 kr) / kg Cr.
YuvToBgr::YuvToBgr(ColourMatrix matrix, bool fullRange) : black_(fullRange ? 0 : 16) {
    const Luma k = lumaOf(matrix);
    const double green = 1 - k.red - k.blue;
    const auto fraction = [](double factor, int shift) {
        return static_cast<int16_t>(std::lround(factor * (1 << (15 + kSumBits - shift))));
    };
    const double difference = fullRange ? 1 : 255.0 / 224;
    const double blue = (2 - 2 * k.blue) * difference, red = (2 - 2 * k.red) * difference;
    luma_ = fraction(fullRange ? 1 : 255.0 / 219, kLumaBits);
    blueOfBlue_ = fraction(blue, kDifferenceBits);
    greenOfBlue_ = fraction(blue * k.blue / green, kDifferenceBits);
    greenOfRed_ = fraction(red * k.red / green, kDifferenceBits);
    redOfRed_ = fraction(red, kDifferenceBits);
}

void YuvToBgr::plain(const YuvRow& row, int first, int width, uint8_t* bgr) const {
    for (int x = first; x < width; ++x) {
        const int y = product((row.luma[x] - black_) << kLumaBits, luma_);
        const int cb = (row.blueDifference[x / 2] - kMiddle) << kDifferenceBits;
        const int cr = (row.redDifference[x / 2] - kMiddle) << kDifferenceBits;
        bgr[3 * x] = level(y + product(cb, blueOfBlue_));
        bgr[3 * x + 1] = level(y - product(cb, greenOfBlue_) - product(cr, greenOfRed_));
        bgr[3 * x + 2] = level(y + product(cr, redOfRed_));
    }
}

#ifdef SHOAL_AVX2

namespace {

// For each third of 16 pixels' 48 bytes: where a channel's bytes come to lie; -1 leaves room for others'.
constexpr auto kPlaces = [] {
    std::array<std::array<std::array<int8_t, 16>, 3>, 3> places{}; // third, channel
    for (size_t third = 0; third < 3; ++third)
        for (size_t channel = 0; channel < 3; ++channel)
            for (size_t i = 0; i < 16; ++i) {
                const size_t byte = 16 * third + i;
                places[third][channel][i] = static_cast<int8_t>(byte % 3 == channel ? byte / 3 : -1);
            }
    return places;
}();

SHOAL_AVX2 inline __m256i placed(__m256i channel, size_t third, size_t which) {
    const auto* place = reinterpret_cast<const __m128i*>(kPlaces[third][which].data());
    return _mm256_shuffle_epi8(channel, _mm256_broadcastsi128_si256(_mm_loadu_si128(place)));
}

SHOAL_AVX2 inline __m256i sixteen(const uint8_t* bytes) {
    return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)));
}

// Two times sixteen sums, each half in two quarters, as levels in the order of the pixels.
SHOAL_AVX2 inline __m256i levels(__m256i low, __m256i high) {
    const __m256i half = _mm256_set1_epi16(1 << (kSumBits - 1));
    return _mm256_packus_epi16(_mm256_srai_epi16(_mm256_add_epi16(low, half), kSumBits),
                               _mm256_srai_epi16(_mm256_add_epi16(high, half), kSumBits));
}

} // namespace

SHOAL_AVX2
int YuvToBgr::avx2(const YuvRow& row, int width, uint8_t* bgr) const {
    constexpr int kStep = 32;
    const __m256i black = _mm256_set1_epi16(black_), luma = _mm256_set1_epi16(luma_);
    const __m256i middle = _mm256_set1_epi16(kMiddle), none = _mm256_setzero_si256();
    const __m256i blueOfBlue = _mm256_set1_epi16(blueOfBlue_), redOfRed = _mm256_set1_epi16(redOfRed_);
    const __m256i greenOfBlue = _mm256_set1_epi16(greenOfBlue_), greenOfRed = _mm256_set1_epi16(greenOfRed_);
    int x = 0;
    for (; x + kStep <= width; x += kStep) {
        const __m256i cb =
            _mm256_slli_epi16(_mm256_sub_epi16(sixteen(row.blueDifference + x / 2), middle), kDifferenceBits);
        const __m256i cr =
            _mm256_slli_epi16(_mm256_sub_epi16(sixteen(row.redDifference + x / 2), middle), kDifferenceBits);
        const __m256i blue = _mm256_mulhrs_epi16(cb, blueOfBlue), red = _mm256_mulhrs_epi16(cr, redOfRed);
        const __m256i green =
            _mm256_add_epi16(_mm256_mulhrs_epi16(cb, greenOfBlue), _mm256_mulhrs_epi16(cr, greenOfRed));
        // Unpacking takes the lower and the upper halves of both 128-bit lanes: of the luma as of the
        // differences, which it doubles on the way.
        const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row.luma + x));
        const auto scaled = [&](__m256i y) SHOAL_AVX2 {
            return _mm256_mulhrs_epi16(_mm256_slli_epi16(_mm256_sub_epi16(y, black), kLumaBits), luma);
        };
        const __m256i low = scaled(_mm256_unpacklo_epi8(bytes, none));
        const __m256i high = scaled(_mm256_unpackhi_epi8(bytes, none));
        const __m256i b = levels(_mm256_add_epi16(low, _mm256_unpacklo_epi16(blue, blue)),
                                 _mm256_add_epi16(high, _mm256_unpackhi_epi16(blue, blue)));
        const __m256i g = levels(_mm256_sub_epi16(low, _mm256_unpacklo_epi16(green, green)),
                                 _mm256_sub_epi16(high, _mm256_unpackhi_epi16(green, green)));
        const __m256i r = levels(_mm256_add_epi16(low, _mm256_unpacklo_epi16(red, red)),
                                 _mm256_add_epi16(high, _mm256_unpackhi_epi16(red, red)));
        auto* out = reinterpret_cast<__m128i*>(bgr + 3 * x);
        for (size_t third = 0; third < 3; ++third) {
            const __m256i both = _mm256_or_si256(_mm256_or_si256(placed(b, third, 0), placed(g, third, 1)),
                                                 placed(r, third, 2));
            _mm_storeu_si128(out + third, _mm256_castsi256_si128(both));
            _mm_storeu_si128(out + 3 + third, _mm256_extracti128_si256(both, 1));
        }
    }
    return x;
}

#else
int YuvToBgr::avx2(const YuvRow&, int, uint8_t*) const { return 0; }
#endif

void YuvToBgr::row(const YuvRow& row, int width, uint8_t* bgr, YuvLoop loop) const {
    assert(runsHere(loop));
    plain(row, loop == YuvLoop::Avx2 ? avx2(row, width, bgr) : 0, width, bgr);
}

void YuvToBgr::row(const YuvRow& row, int width, uint8_t* bgr) const {
    static const YuvLoop best = runsHere(YuvLoop::Avx2) ? YuvLoop::Avx2 : YuvLoop::Plain;
    this->row(row, width, bgr, best);
}

} // namespace shoal::media
