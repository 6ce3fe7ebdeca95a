#include "engine/light/BruteForceDiffuse.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"

#include <cassert>
#include <numbers>

namespace shoal::light {

namespace {

constexpr size_t kBlock = 64; // output texels of one pass, few enough for their sums to stay in the L1 cache

// Computes kBlock output texels from `first` on. out: interleaved.
SHOAL_VECTORISE
void gather(const BruteForceDiffuse::Planes& directions, const BruteForceDiffuse::Planes& light, size_t first,
            float* __restrict out) {
    float sums[3][kBlock] = {};
    const float *nx = directions[0].data() + first, *ny = directions[1].data() + first,
                *nz = directions[2].data() + first;
    for (size_t i = 0; i < light[0].size(); ++i) {
        const float x = directions[0][i], y = directions[1][i], z = directions[2][i];
        const float r = light[0][i], g = light[1][i], b = light[2][i];
        for (size_t k = 0; k < kBlock; ++k) {
            const float cosine = nx[k] * x + ny[k] * y + nz[k] * z;
            const float clamped = cosine > 0 ? cosine : 0;
            sums[0][k] += clamped * r;
            sums[1][k] += clamped * g;
            sums[2][k] += clamped * b;
        }
    }
    for (size_t k = 0; k < kBlock; ++k)
        for (size_t c = 0; c < 3; ++c) out[3 * k + c] = sums[c][k];
}

} // namespace

BruteForceDiffuse::BruteForceDiffuse(int width) : width_(width) {
    const int height = width / 2;
    assert(width % 16 == 0);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const auto d = texelDirection<double>(column, row, width, height);
            for (int c = 0; c < 3; ++c) directions_[c].push_back(static_cast<float>(d[c]));
            solidAngleOverPi_.push_back(
                static_cast<float>(texelSolidAngle(row, width, height) * std::numbers::inv_pi));
        }
    for (auto& plane : light_) plane.resize(solidAngleOverPi_.size());
}

void BruteForceDiffuse::make(const RadiancePyramid& pyramid, ImageRgbF& out) {
    if (pyramid.levels[0].width < width_) *this = BruteForceDiffuse(pyramid.levels[0].width);
    const ImageRgbF& level = pyramid.ofWidth(width_);
    const size_t texels = solidAngleOverPi_.size();
    for (size_t i = 0; i < texels; ++i)
        for (size_t c = 0; c < 3; ++c) light_[c][i] = level.pixels[3 * i + c] * solidAngleOverPi_[i];
    out.fit(width_, width_ / 2);
    for (size_t i = 0; i < texels; i += kBlock) gather(directions_, light_, i, &out.pixels[3 * i]);
}

} // namespace shoal::light
