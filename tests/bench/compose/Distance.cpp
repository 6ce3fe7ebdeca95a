#include "tests/bench/compose/Distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace shoal::bench {

namespace {

constexpr int kPatch = 32, kNear = 4;
using Spectrum = std::array<double, kPatch / 2>; // power by whole cycles a patch, from 0

float luma(const ImageRgba8& image, int x, int y) {
    const uint8_t* c = image.at(x, y);
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

// Returns, for each pixel, the largest or smallest coverage within kNear pixels.
Coverage spread(const Coverage& in, bool largest) {
    Coverage along = in, out = in;
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x)
            for (int i = std::max(x - kNear, 0); i <= std::min(x + kNear, in.width - 1); ++i)
                *along.at(x, y) = largest ? std::max(*along.at(x, y), *in.at(i, y))
                                          : std::min(*along.at(x, y), *in.at(i, y));
    out = along;
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x)
            for (int j = std::max(y - kNear, 0); j <= std::min(y + kNear, in.height - 1); ++j)
                *out.at(x, y) = largest ? std::max(*out.at(x, y), *along.at(x, j))
                                        : std::min(*out.at(x, y), *along.at(x, j));
    return out;
}

void addSpectrum(const ImageRgba8& image, int left, int top, Spectrum& sum) {
    static const auto turns = [] {
        std::array<std::complex<double>, kPatch> table;
        for (size_t i = 0; i < kPatch; ++i)
            table[i] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / kPatch);
        return table;
    }();
    double mean = 0;
    for (int i = 0; i < kPatch * kPatch; ++i)
        mean += static_cast<double>(luma(image, left + i % kPatch, top + i / kPatch)) / (kPatch * kPatch);
    std::vector<std::complex<double>> rows(kPatch * kPatch);
    const auto window = [](int i) { return 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 0.5) / kPatch); };
    for (int y = 0; y < kPatch; ++y)
        for (int k = 0; k < kPatch; ++k)
            for (int x = 0; x < kPatch; ++x)
                rows[static_cast<size_t>(y * kPatch + k)] +=
                    window(x) * window(y) * (static_cast<double>(luma(image, left + x, top + y)) - mean) *
                    turns[static_cast<size_t>(k * x % kPatch)];
    for (int k = 0; k < kPatch; ++k)
        for (int l = 0; l < kPatch; ++l) {
            std::complex<double> value;
            for (int y = 0; y < kPatch; ++y)
                value +=
                    rows[static_cast<size_t>(y * kPatch + k)] * turns[static_cast<size_t>(l * y % kPatch)];
            const double fx = k < kPatch / 2 ? k : k - kPatch, fy = l < kPatch / 2 ? l : l - kPatch;
            const auto ring = static_cast<size_t>(std::lround(std::hypot(fx, fy)));
            if (ring < sum.size()) sum[ring] += std::norm(value);
        }
}

struct Patch {
    int left, top;
};

// Returns the share of the power beyond an eighth of a cycle a pixel.
double detail(const Spectrum& spectrum) {
    double all = 0, fine = 0;
    for (size_t ring = 1; ring < spectrum.size(); ++ring) {
        all += spectrum[ring];
        if (ring > kPatch / 8) fine += spectrum[ring];
    }
    return fine / std::max(all, 1e-9);
}

} // namespace

Distance distance(const ImageRgba8& shown, const ImageRgba8& truth, const Coverage& objects) {
    const Coverage wide = spread(objects, true), inside = spread(objects, false);
    Distance out;
    double squares = 0, colourSquares = 0, laplacians = 0;
    int64_t count = 0, insideCount = 0;
    for (int y = 1; y + 1 < shown.height; ++y)
        for (int x = 1; x + 1 < shown.width; ++x) {
            if (*wide.at(x, y) <= 0) continue;
            squares += std::pow(luma(shown, x, y) - luma(truth, x, y), 2);
            for (int c = 0; c < 3; ++c)
                colourSquares += std::pow(shown.at(x, y)[c] - truth.at(x, y)[c], 2) / 3;
            ++count;
            if (*inside.at(x, y) < 1) continue;
            float v = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    v += static_cast<float>((i ? 1 : -2) * (j ? 1 : -2)) * luma(shown, x + i, y + j);
            laplacians += static_cast<double>(v * v) / 36;
            ++insideCount;
        }
    const auto mean = [](double sum, int64_t n) {
        return std::sqrt(sum / static_cast<double>(std::max<int64_t>(n, 1)));
    };
    out.luma = mean(squares, count);
    out.colour = mean(colourSquares, count);
    out.noise = mean(laplacians, insideCount);

    Spectrum ours{}, theirs{}, around{};
    for (int top = 0; top + kPatch <= shown.height; top += kPatch / 2)
        for (int left = 0; left + kPatch <= shown.width; left += kPatch / 2) {
            double covered = 0, near = 0;
            for (int i = 0; i < kPatch * kPatch; ++i) {
                covered +=
                    static_cast<double>(*objects.at(left + i % kPatch, top + i / kPatch)) / (kPatch * kPatch);
                near +=
                    static_cast<double>(*wide.at(left + i % kPatch, top + i / kPatch)) / (kPatch * kPatch);
            }
            if (covered > 0.25) {
                addSpectrum(shown, left, top, ours);
                addSpectrum(truth, left, top, theirs);
            } else if (near == 0) {
                bool beside = false; // within two patches
                for (int j = -2; j <= 2; ++j)
                    for (int i = -2; i <= 2; ++i) {
                        const int x = left + kPatch / 2 + i * kPatch, y = top + kPatch / 2 + j * kPatch;
                        beside |=
                            x >= 0 && y >= 0 && x < shown.width && y<shown.height&& * objects.at(x, y)> 0.5f;
                    }
                if (beside) addSpectrum(shown, left, top, around);
            }
        }
    int rings = 0;
    for (size_t ring = 1; ring < ours.size(); ++ring, ++rings)
        out.spectrum_db += std::pow(10 * std::log10((ours[ring] + 1) / (theirs[ring] + 1)), 2);
    out.spectrum_db = std::sqrt(out.spectrum_db / std::max(rings, 1));
    out.detail_db = 10 * std::log10(detail(ours) / std::max(detail(around), 1e-9));
    return out;
}

} // namespace shoal::bench
