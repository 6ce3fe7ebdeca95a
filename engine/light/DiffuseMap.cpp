#include "engine/light/DiffuseMap.h"

#include "engine/light/Vectorise.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace shoal::light {

namespace {

using std::numbers::pi;

constexpr int kFineRows = 4, kFineColumns = 4; // points a texel, for the cosine's integral over it

// out[i] = sum over k of weights[k] rows[k][i]; kBlock of i at a time stay in registers.
template <int kBlock>
inline void combine(const float* __restrict weights, const float* __restrict rows, int count, int length,
                    float* __restrict out) {
    for (int start = 0; start < length; start += kBlock) {
        float sum[kBlock] = {};
        for (int k = 0; k < count; ++k) {
            const float* row = rows + k * length + start;
            for (int i = 0; i < kBlock; ++i) sum[i] += weights[k] * row[i];
        }
        for (int i = 0; i < kBlock; ++i) out[start + i] = sum[i];
    }
}

// Wave 0 is the mean, waves 2m - 1 and 2m are cosine and sine of frequency m, the last is the highest cosine
// alone.
int frequencyOf(int wave) { return (wave + 1) / 2; }

SHOAL_VECTORISE
void transform(const float* __restrict matrix, const float* __restrict in, int count, int length,
               float* __restrict out) {
    for (int k = 0; k < count; ++k) combine<32>(matrix + k * count, in, count, length, out + k * length);
}

SHOAL_VECTORISE
void light(const float* __restrict kernel, const float* __restrict in, int waves, int height,
           float* __restrict out) {
    for (int wave = 0; wave < waves; ++wave)
        for (int c = 0; c < 3; ++c) {
            const int at = (wave * 3 + c) * height;
            combine<32>(in + at, kernel + (wave + 1) / 2 * height * height, height, height, out + at);
        }
}

} // namespace

DiffuseMap::DiffuseMap()
    : basis_(kWidth * kWidth), basisTurned_(kWidth * kWidth),
      kernel_(static_cast<size_t>(kFrequencies) * kHeight * kHeight), columns_(kWidth * kRun),
      waves_(kWidth * kRun), lit_(kWidth * kRun) {
    for (int wave = 0; wave < kWidth; ++wave)
        for (int x = 0; x < kWidth; ++x) {
            const int m = frequencyOf(wave);
            const bool alone = m == 0 || m == kWidth / 2;
            const double angle = 2 * pi * m * x / kWidth;
            const double value = std::sqrt((alone ? 1.0 : 2.0) / kWidth) *
                                 (alone || wave % 2 ? std::cos(angle) : std::sin(angle));
            basis_[static_cast<size_t>(wave * kWidth + x)] = static_cast<float>(value);
            basisTurned_[static_cast<size_t>(x * kWidth + wave)] = static_cast<float>(value);
        }

    std::array<double, kWidth * kFineColumns> cosines;
    for (size_t i = 0; i < cosines.size(); ++i)
        cosines[i] = std::cos(2 * pi * (static_cast<double>(i) + 0.5 - kFineColumns / 2) /
                              static_cast<double>(cosines.size()));
    std::array<double, kHeight * kFineRows> sine, ring, part;
    for (int i = 0; i < kHeight * kFineRows; ++i) {
        const double latitude = pi * (0.5 - (i + 0.5) / (kHeight * kFineRows));
        sine[static_cast<size_t>(i)] = std::sin(latitude);
        ring[static_cast<size_t>(i)] = std::cos(latitude);
        part[static_cast<size_t>(i)] = texelSolidAngle(i, kWidth * kFineColumns, kHeight * kFineRows);
    }

    std::vector<double> spatial(static_cast<size_t>(kHeight) *
                                kWidth); // for one output row: [row in][column difference]
    for (int out = 0; out < kHeight; ++out) {
        const double latitude = pi * (0.5 - (out + 0.5) / kHeight);
        const double up = std::sin(latitude), along = std::cos(latitude);
        std::fill(spatial.begin(), spatial.end(), 0.0);
        double total = 0;
        for (int in = 0; in < kHeight * kFineRows; ++in) {
            const auto i = static_cast<size_t>(in);
            double* row = spatial.data() + in / kFineRows * kWidth;
            for (size_t x = 0; x < cosines.size(); ++x) {
                const double cosine = std::max(0.0, up * sine[i] + along * ring[i] * cosines[x]);
                row[x / kFineColumns] += cosine * part[i];
                total += cosine * part[i];
            }
        }
        for (int m = 0; m < kFrequencies; ++m)
            for (int in = 0; in < kHeight; ++in) {
                double sum = 0;
                for (int d = 0; d < kWidth; ++d)
                    sum += spatial[static_cast<size_t>(in * kWidth + d)] * std::cos(2 * pi * m * d / kWidth);
                kernel_[static_cast<size_t>((m * kHeight + in) * kHeight + out)] =
                    static_cast<float>(sum / total);
            }
    }
}

void DiffuseMap::make(const ImageRgbF& in, ImageRgbF& out) {
    assert(in.width == kWidth && in.height == kHeight);
    if (out.width != kWidth || out.height != kHeight) out = ImageRgbF(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                columns_[static_cast<size_t>(x * kRun + c * kHeight + y)] = in.at(x, y)[c];
    transform(basis_.data(), columns_.data(), kWidth, kRun, waves_.data());
    light(kernel_.data(), waves_.data(), kWidth, kHeight, lit_.data());
    transform(basisTurned_.data(), lit_.data(), kWidth, kRun, columns_.data());
    // Rounding may leave a hair below zero where no light comes from.
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y)[c] = std::max(0.0f, columns_[static_cast<size_t>(x * kRun + c * kHeight + y)]);
}

} // namespace shoal::light
