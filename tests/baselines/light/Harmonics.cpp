#include "tests/baselines/light/Harmonics.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"

#include <cassert>

namespace shoal::light::baselines {

using std::numbers::pi;

Harmonics::Harmonics(int bands) : bands_(bands) {
    assert(bands >= 1 && bands <= kMaxBands);
    double first = std::sqrt(0.25 / pi);
    for (int m = 0; m < kMaxBands; ++m) {
        if (m) first *= std::sqrt((2 * m + 1.0) / (2 * m));
        first_[m] = static_cast<float>(m ? std::numbers::sqrt2 * first : first);
        for (int l = m + 1; l < kMaxBands; ++l) {
            const double l2 = l * l, m2 = m * m, before = (l - 1) * (l - 1);
            const auto at = static_cast<size_t>(l * kMaxBands + m);
            raise_[at] = static_cast<float>(std::sqrt((4 * l2 - 1) / (l2 - m2)));
            drop_[at] = static_cast<float>(std::sqrt((before - m2) / (4 * before - 1)));
        }
    }
}

void Harmonics::evaluate(const glm::vec3& dir, std::array<float, kMaxHarmonics>& out) const {
    float cosine = 1, sine = 0; // times ring^m
    for (int m = 0; m < bands_; ++m) {
        float before = 0, now = first_[m];
        for (int l = m;;) {
            out[l * (l + 1) + m] = now * cosine;
            if (m) out[l * (l + 1) - m] = now * sine;
            if (++l == bands_) break;
            const auto at = static_cast<size_t>(l * kMaxBands + m);
            const float next = raise_[at] * (dir.y * now - drop_[at] * before);
            before = now, now = next;
        }
        const float turned = -dir.z * cosine - dir.x * sine;
        sine = -dir.z * sine + dir.x * cosine;
        cosine = turned;
    }
}

HarmonicProjection::HarmonicProjection(int width, int bands) : width_(width), bands_(bands) {
    const Harmonics harmonics(bands);
    std::array<float, kMaxHarmonics> values{};
    // Integrals over whole texels, not values at their centres: else uniform light would leak into higher
    // bands.
    for (int column = 0; column < width; ++column) {
        const double longitude = ((column + 0.5) / width - 0.5) * 2 * pi;
        const auto mean = [&](int m) { return m ? std::sin(m * pi / width) / (m * pi / width) : 1.0; };
        for (int m = 0; m < kMaxBands; ++m)
            turns_.push_back(static_cast<float>(mean(m) * std::cos(m * longitude)));
        for (int m = 0; m < kMaxBands; ++m)
            turns_.push_back(static_cast<float>(mean(m) * std::sin(m * longitude)));
    }
    constexpr int kParts = 16;
    const int height = width / 2 * kParts;
    for (int row = 0; row < width / 2; ++row) {
        std::array<double, kMaxHarmonics> sums{}; // [l * kMaxBands + m]
        for (int part = row * kParts; part < (row + 1) * kParts; ++part) {
            harmonics.evaluate(glm::vec3(directionFromLatLong(glm::dvec2(0.5, (part + 0.5) / height))),
                               values);
            for (int l = 0; l < bands; ++l)
                for (int m = 0; m <= l; ++m)
                    sums[l * kMaxBands + m] += texelSolidAngle(part, width, height) * values[l * (l + 1) + m];
        }
        for (const double sum : sums) rows_.push_back(static_cast<float>(sum));
    }
}

namespace {

// Sums over a row's columns: out[channel][lane].
template <int kLanes>
SHOAL_VECTORISE void sumRow(const float* __restrict texels, const float* __restrict turns, int width,
                            float* __restrict out) {
    float r[kLanes] = {}, g[kLanes] = {}, b[kLanes] = {};
    for (int x = 0; x < width; ++x)
        for (int lane = 0; lane < kLanes; ++lane) {
            const float turn = turns[x * kLanes + lane];
            r[lane] += texels[3 * x] * turn;
            g[lane] += texels[3 * x + 1] * turn;
            b[lane] += texels[3 * x + 2] * turn;
        }
    for (int lane = 0; lane < kLanes; ++lane)
        out[lane] = r[lane], out[kLanes + lane] = g[lane], out[2 * kLanes + lane] = b[lane];
}

} // namespace

void HarmonicProjection::project(const ImageRgbF& level, HarmonicRgb& out) {
    assert(level.width == width_);
    out.fill(glm::vec3(0));
    std::array<float, 3 * kLanes> sums{};
    for (int row = 0; row < level.height; ++row) {
        sumRow<kLanes>(level.at(0, row), turns_.data(), width_, sums.data());
        const float* weights = &rows_[static_cast<size_t>(row) * kMaxHarmonics];
        for (int l = 0; l < bands_; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto lane = static_cast<size_t>(m < 0 ? kMaxBands - m : m);
                out[l * (l + 1) + m] += weights[l * kMaxBands + std::abs(m)] *
                                        glm::vec3(sums[lane], sums[kLanes + lane], sums[2 * kLanes + lane]);
            }
    }
}

// Midpoints in s, cosine = 1 - 2 s^3: dense near the peak of a narrow lobe.
std::vector<double> zonalFactors(const std::function<double(double cosine)>& lobe, int bands) {
    constexpr int kSteps = 20000;
    std::vector<double> sums(static_cast<size_t>(bands), 0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double s = (i + 0.5) / kSteps, cosine = 1 - 2 * s * s * s;
        const double weight = lobe(cosine) * s * s;
        double before = 0, now = 1; // Legendre polynomials
        for (int l = 0; l < bands; ++l) {
            sums[l] += weight * now;
            const double next = ((2 * l + 1) * cosine * now - l * before) / (l + 1);
            before = now, now = next;
        }
    }
    for (size_t l = sums.size(); l-- > 0;) sums[l] /= sums[0];
    return sums;
}

} // namespace shoal::light::baselines
