#include "engine/media/YuvToBgr.h"

#include "engine/core/Vectorise.h"

#include <opencv2/core.hpp>

extern "C" {
#include <libavutil/csp.h>
}

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::media {

namespace {

// Sums are in units of 1/32 level: they fit in 16 bits, and rounding a product changes it by 1/64 at most.
constexpr int kSumBits = 5;
constexpr int kLumaBits = 7, kDifferenceBits = 8; // shifts that fill 16 bits before they are multiplied
constexpr int kMiddle = 128;                      // code of a difference of 0

// Returns the rounded product of two fractions of 2^15, in a form that GCC compiles to one instruction.
int16_t product(int16_t a, int16_t b) { return static_cast<int16_t>((((a * b) >> 14) + 1) >> 1); }

// Fixed-point factors: of luma times 2^13, of differences times 2^12. black: the luma code of black.
struct Factors {
    int16_t black, luma, blueOfBlue, greenOfBlue, greenOfRed, redOfRed;
};

// Computes what a row's differences add to the luma of each pixel: by channel, blue first.
SHOAL_VECTORISE
void addends(const uint8_t* __restrict blueDifference, const uint8_t* __restrict redDifference, int pairs,
             const Factors& factors, int16_t* __restrict blue, int16_t* __restrict green,
             int16_t* __restrict red) {
    for (int i = 0; i < pairs; ++i) {
        const auto cb = static_cast<int16_t>((blueDifference[i] - kMiddle) << kDifferenceBits);
        const auto cr = static_cast<int16_t>((redDifference[i] - kMiddle) << kDifferenceBits);
        blue[2 * i] = blue[2 * i + 1] = product(cb, factors.blueOfBlue);
        green[2 * i] = green[2 * i + 1] =
            static_cast<int16_t>(-product(cb, factors.greenOfBlue) - product(cr, factors.greenOfRed));
        red[2 * i] = red[2 * i + 1] = product(cr, factors.redOfRed);
    }
}

SHOAL_VECTORISE
void levels(const uint8_t* __restrict luma, const int16_t* __restrict add, int width, const Factors& factors,
            uint8_t* __restrict out) {
    const int16_t black = factors.black, scale = factors.luma;
    for (int x = 0; x < width; ++x) {
        const int16_t y = product(static_cast<int16_t>((luma[x] - black) << kLumaBits), scale);
        const auto sum = static_cast<int16_t>(y + add[x] + (1 << (kSumBits - 1)));
        out[x] = static_cast<uint8_t>(std::clamp<int16_t>(sum >> kSumBits, 0, 255));
    }
}

// The formula, with weights kr, kg, kb of luma and differences of +-1/2 (BT.601, BT.709 item 3):
//   R = Y + (2 - 2 kr) Cr,  B = Y + (2 - 2 kb) Cb,
//   G = (Y - kr R - kb B) / kg = Y - kb (2 - 2 kb) / kg Cb - kr (2 - 2 kr) / kg Cr.
Factors factorsOf(ColourMatrix matrix, bool fullRange) {
    const Luma k = lumaOf(matrix);
    const double green = 1 - k.red - k.blue;
    const auto fraction = [](double factor, int shift) {
        return static_cast<int16_t>(std::lround(factor * (1 << (15 + kSumBits - shift))));
    };
    const double difference = fullRange ? 1 : 255.0 / 224;
    const double blue = (2 - 2 * k.blue) * difference, red = (2 - 2 * k.red) * difference;
    return {.black = static_cast<int16_t>(fullRange ? 0 : 16),
            .luma = fraction(fullRange ? 1 : 255.0 / 219, kLumaBits),
            .blueOfBlue = fraction(blue, kDifferenceBits),
            .greenOfBlue = fraction(blue * k.blue / green, kDifferenceBits),
            .greenOfRed = fraction(red * k.red / green, kDifferenceBits),
            .redOfRed = fraction(red, kDifferenceBits)};
}

} // namespace

Luma lumaOf(ColourMatrix matrix) {
    const AVLumaCoefficients* luma = av_csp_luma_coeffs_from_avcsp(static_cast<AVColorSpace>(matrix));
    return {av_q2d(luma->cr), av_q2d(luma->cb)};
}

const char* nameOf(ColourMatrix matrix) {
    return matrix == ColourMatrix::Bt709 ? "BT.709" : matrix == ColourMatrix::Bt601 ? "BT.601" : "BT.2020";
}

ColourMatrix colourMatrixOf(int code, int width, int height) {
    if (code == 1) return ColourMatrix::Bt709;
    if (code == 5 || code == 6) return ColourMatrix::Bt601;
    if (code == 9) return ColourMatrix::Bt2020;
    return width >= 1280 || height > 576 ? ColourMatrix::Bt709 : ColourMatrix::Bt601;
}

void toBgr(const YuvPicture& yuv, ImageRgb8& bgr) {
    const Factors factors = factorsOf(yuv.matrix, yuv.fullRange);
    const int width = bgr.width, pairs = (width + 1) / 2;
    std::vector<int16_t> add(static_cast<size_t>(6 * pairs));
    std::vector<uint8_t> values(static_cast<size_t>(3 * width));
    for (int y = 0; y < bgr.height; ++y) {
        const auto row = [&](size_t plane, int at) { return yuv.planes[plane] + at * yuv.strides[plane]; };
        const int differences = y / yuv.rowsPerDifference;
        addends(row(1, differences), row(2, differences), pairs, factors, add.data(), &add[2 * pairs],
                &add[4 * pairs]);
        cv::Mat channels[3];
        for (int c = 0; c < 3; ++c) {
            channels[c] = cv::Mat(1, width, CV_8U, &values[c * width]);
            levels(row(0, y), &add[2 * c * pairs], width, factors, channels[c].data);
        }
        cv::merge(channels, 3, cv::Mat(1, width, CV_8UC3, bgr.at(0, y)));
    }
}

} // namespace shoal::media
