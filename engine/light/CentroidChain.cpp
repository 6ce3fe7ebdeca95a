#include "engine/light/CentroidChain.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace shoal::light {

namespace {

SHOAL_VECTORISE
void mixRows(const std::array<const float*, 4>& rows, const std::array<float, 4>& weights, int count,
             float* __restrict out) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    for (int i = 0; i < count; ++i)
        out[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] + weights[3] * d[i];
}

// Halves a row. One texel before `in` and one texel and a float after its end must be readable.
SHOAL_VECTORISE
void halveRow(const float* __restrict in, int width, float* __restrict out) {
    using Texel4 = float __attribute__((vector_size(16))); // a texel, and the first float of the next one
    const auto texelAt = [in](int x) {
        Texel4 texel;
        std::memcpy(&texel, in + 3 * x, sizeof texel);
        return texel;
    };
    for (int x = 0; x < width; ++x) {
        const Texel4 texel = 0.125f * (texelAt(2 * x - 1) + texelAt(2 * x + 2)) +
                             0.375f * (texelAt(2 * x) + texelAt(2 * x + 1));
        // The next texel overwrites the extra float.
        std::memcpy(out + 3 * x, &texel, x + 1 < width ? sizeof texel : 3 * sizeof(float));
    }
}

constexpr std::array<double, 4> kShares = {0.25, 0.75, 0.75, 0.25}; // weights of rows 2 y - 1 .. 2 y + 2

} // namespace

CentroidChain::CentroidChain(int baseWidth) {
    constexpr int kMinWidth = 64;
    assert(std::has_single_bit(static_cast<unsigned>(baseWidth)) && baseWidth >= kMinWidth);
    Sampling base{baseWidth, 0, {}};
    for (int y = 0; y < baseWidth / 2; ++y)
        base.rowFlux.push_back(texelSolidAngle(y, baseWidth, baseWidth / 2));
    samplings_.push_back(std::move(base));
    while (samplings_.back().width > kMinWidth) {
        const Sampling& wide = samplings_.back();
        const int height = wide.width / 2;
        Sampling half{wide.width / 2, wide.octaves + 1, {}};
        for (int y = 0; y < height / 2; ++y) {
            double flux = 0;
            for (int i = 0; i < 4; ++i)
                flux += 2 * kShares[i] * wide.rowFlux[rowOnSphere(2 * y - 1 + i, height)];
            half.rowFlux.push_back(flux);
        }
        levels_.emplace_back(half.width, half.width / 2);
        samplings_.push_back(std::move(half));
    }
    row_.resize(static_cast<size_t>(baseWidth + 2) * 3 + 1);
    overPole_.resize(static_cast<size_t>(baseWidth) * 3);
}

void CentroidChain::make(const ImageRgbF& base) {
    assert(base.width == samplings_[0].width && base.height == base.width / 2);
    base_ = &base;
    for (size_t k = 0; k < levels_.size(); ++k) {
        const ImageRgbF& in = k ? levels_[k - 1] : base;
        ImageRgbF& out = levels_[k];
        const int count = in.width * 3;
        for (int y = 0; y < out.height; ++y) {
            std::array<const float*, 4> rows;
            std::array<float, 4> weights;
            for (int i = 0; i < 4; ++i) {
                const int at = 2 * y - 1 + i, row = rowOnSphere(at, in.height);
                rows[i] = in.at(0, row);
                if (row != at) { // beyond the pole
                    std::rotate_copy(rows[i], rows[i] + count / 2, rows[i] + count, overPole_.data());
                    rows[i] = overPole_.data();
                }
                weights[i] = static_cast<float>(2 * kShares[i] * samplings_[k].rowFlux[row] /
                                                samplings_[k + 1].rowFlux[y]);
            }
            float* mixed = row_.data() + 3;
            mixRows(rows, weights, count, mixed);
            std::copy_n(mixed + count - 3, 3, row_.data());
            std::copy_n(mixed, 3, mixed + count);
            halveRow(mixed, out.width, out.at(0, y));
        }
    }
}

const ImageRgbF& CentroidChain::level(int width) const {
    const int index = indexOf(width);
    return index ? levels_[index - 1] : *base_;
}

const Sampling& CentroidChain::sampling(int width) const { return samplings_[indexOf(width)]; }

} // namespace shoal::light
