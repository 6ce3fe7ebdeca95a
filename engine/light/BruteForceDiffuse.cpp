#include "engine/light/BruteForceDiffuse.h"

#include "engine/light/Vectorise.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace shoal::light {

namespace {

constexpr size_t kBlock = 64; // texels out, so that their sums stay in the nearest cache

struct Incoming {
    const float *x, *y, *z, *r, *g, *b;
    size_t count;
};

SHOAL_VECTORISE
void gather(const float* __restrict nx, const float* __restrict ny, const float* __restrict nz,
            const Incoming& in, float* __restrict outR, float* __restrict outG, float* __restrict outB) {
    for (size_t i = 0; i < in.count; ++i) {
        const float x = in.x[i], y = in.y[i], z = in.z[i], r = in.r[i], g = in.g[i], b = in.b[i];
        for (size_t k = 0; k < kBlock; ++k) {
            const float cosine = nx[k] * x + ny[k] * y + nz[k] * z;
            const float clamped = cosine > 0 ? cosine : 0;
            outR[k] += clamped * r;
            outG[k] += clamped * g;
            outB[k] += clamped * b;
        }
    }
}

} // namespace

BruteForceDiffuse::BruteForceDiffuse(int width) : width_(width) {
    const int height = width / 2;
    assert(width % 16 == 0);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const auto d = directionFromLatLong(glm::dvec2((column + 0.5) / width, (row + 0.5) / height));
            x_.push_back(static_cast<float>(d.x));
            y_.push_back(static_cast<float>(d.y));
            z_.push_back(static_cast<float>(d.z));
            solidAngleOverPi_.push_back(
                static_cast<float>(texelSolidAngle(row, width, height) * std::numbers::inv_pi));
        }
    for (auto* plane : {&r_, &g_, &b_}) plane->resize(x_.size());
}

void BruteForceDiffuse::make(const RadiancePyramid& pyramid, ImageRgbF& out) {
    const auto level =
        std::ranges::find_if(pyramid.levels, [&](const ImageRgbF& each) { return each.width == width_; });
    assert(level != pyramid.levels.end());
    for (size_t i = 0; i < x_.size(); ++i) {
        r_[i] = level->pixels[3 * i] * solidAngleOverPi_[i];
        g_[i] = level->pixels[3 * i + 1] * solidAngleOverPi_[i];
        b_[i] = level->pixels[3 * i + 2] * solidAngleOverPi_[i];
    }
    for (auto* sums : {&sumR_, &sumG_, &sumB_}) sums->assign(x_.size(), 0.0f);
    const Incoming in{x_.data(), y_.data(), z_.data(), r_.data(), g_.data(), b_.data(), x_.size()};
    for (size_t i = 0; i < x_.size(); i += kBlock)
        gather(&x_[i], &y_[i], &z_[i], in, &sumR_[i], &sumG_[i], &sumB_[i]);
    if (out.width != width_ || out.height != width_ / 2) out = ImageRgbF(width_, width_ / 2);
    for (size_t i = 0; i < x_.size(); ++i)
        out.pixels[3 * i] = sumR_[i], out.pixels[3 * i + 1] = sumG_[i], out.pixels[3 * i + 2] = sumB_[i];
}

} // namespace shoal::light
