#include "tests/baselines/light/Baselines.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"
#include "tests/baselines/light/Harmonics.h"
#include "tests/baselines/light/Solve.h"

#include <memory>

namespace shoal::light::baselines {

using std::numbers::pi;

namespace {

constexpr int kWidth = 64; // of the level projected; lobes are ten times as wide as its texels
constexpr int kTable = 256;

// G(d) = exp(sharpness (axis.d - 1)). Neighbours, sqrt(4 pi / lobes) apart, meet at 0.85 of the peak.
double sharpnessOf(int lobes) { return std::log(0.85) / (std::cos(0.5 * std::sqrt(4 * pi / lobes)) - 1); }

SHOAL_VECTORISE
void addScaled(const float* __restrict in, float r, float g, float b, size_t count, float* __restrict outR,
               float* __restrict outG, float* __restrict outB) {
    for (size_t i = 0; i < count; ++i) {
        outR[i] += in[i] * r;
        outG[i] += in[i] * g;
        outB[i] += in[i] * b;
    }
}

struct State {
    std::vector<glm::vec3> axes;
    std::vector<float> projection; // [texel][lobe]: strengths are this times radiance
    std::vector<float> table;      // what a matte surface makes of one lobe, by cosine from -1 to 1
    std::vector<float> r, g, b;    // strengths

    explicit State(int lobes) {
        const auto count = static_cast<size_t>(lobes);
        for (int i = 0; i < lobes; ++i) {
            const double y = 1 - (2 * i + 1.0) / lobes, turn = i * pi * (3 - std::sqrt(5.0));
            const double ring = std::sqrt(1 - y * y);
            axes.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
        }

        // Least squares over the sphere, with a trace of damping: strengths = (B W B' + damping)^-1 B W L.
        const double sharpness = sharpnessOf(lobes);
        const int height = kWidth / 2;
        const auto texels = static_cast<size_t>(kWidth * height);
        std::vector<double> gram(count * count), right(count * texels), values(count);
        for (size_t texel = 0; texel < texels; ++texel) {
            const int row = static_cast<int>(texel) / kWidth, column = static_cast<int>(texel) % kWidth;
            const auto d = texelDirection<double>(column, row, kWidth, height);
            const double solidAngle = texelSolidAngle(row, kWidth, height);
            for (size_t i = 0; i < count; ++i)
                values[i] = std::exp(sharpness * (glm::dot(glm::dvec3(axes[i]), d) - 1));
            for (size_t i = 0; i < count; ++i) {
                right[i * texels + texel] = values[i] * solidAngle;
                for (size_t j = 0; j < count; ++j) gram[i * count + j] += values[i] * values[j] * solidAngle;
            }
        }
        for (size_t i = 0; i < count; ++i) gram[i * count + i] *= 1 + 1e-4;
        solve(gram, right, count);
        projection.resize(right.size());
        for (size_t i = 0; i < count; ++i)
            for (size_t texel = 0; texel < texels; ++texel)
                projection[texel * count + i] = static_cast<float>(right[i * texels + texel]);

        // The convolution of two zonal functions, by their Legendre series.
        constexpr int kSeries = 40;
        const auto ofLobe = zonalFactors([=](double c) { return std::exp(sharpness * (c - 1)); }, kSeries);
        const auto ofCosine = zonalFactors(diffuseLobe(), kSeries);
        const double whole = 2 * pi * (1 - std::exp(-2 * sharpness)) / sharpness;
        for (int i = 0; i <= kTable; ++i) {
            const double cosine = 2.0 * i / kTable - 1;
            double sum = 0, before = 0, now = 1;
            for (int l = 0; l < kSeries; ++l) {
                const auto at = static_cast<size_t>(l);
                sum += (2 * l + 1) * ofLobe[at] * ofCosine[at] * now;
                const double next = ((2 * l + 1) * cosine * now - l * before) / (l + 1);
                before = now, now = next;
            }
            table.push_back(static_cast<float>(sum * whole / (4 * pi)));
        }
    }

    void make(const ImageRgbF& level) {
        for (auto* plane : {&r, &g, &b}) plane->assign(axes.size(), 0.0f);
        const float* in = level.pixels.data();
        for (size_t i = 0; i < projection.size(); i += axes.size(), in += 3)
            addScaled(&projection[i], in[0], in[1], in[2], axes.size(), r.data(), g.data(), b.data());
    }

    glm::vec3 shade(const glm::vec3& n) const {
        glm::vec3 sum(0);
        for (size_t i = 0; i < axes.size(); ++i) {
            const float at =
                std::clamp((glm::dot(n, axes[i]) + 1) * (kTable / 2), 0.0f, kTable * (1 - 1e-6f));
            const auto low = static_cast<size_t>(at);
            const float f = at - static_cast<float>(low);
            sum += glm::vec3(r[i], g[i], b[i]) * (table[low] * (1 - f) + table[low + 1] * f);
        }
        return sum;
    }
};

} // namespace

DiffuseMethod sphericalGaussians(int lobes) {
    auto state = std::make_shared<State>(lobes);
    const std::string count = std::to_string(lobes);
    return {
        {count + " spherical Gaussians", "SG " + count, "spherical Gaussians", "after Michiels et al. 2014"},
        [state](const Input& input) { state->make(input.pyramid->ofWidth(kWidth)); },
        [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
            for (size_t i = 0; i < normals.size(); ++i) out[i] = state->shade(normals[i]);
        }};
}

} // namespace shoal::light::baselines
