#include "tests/baselines/light/Taps.h"

#include "engine/math/Brdf.h"
#include "tests/baselines/light/Harmonics.h"
#include "tests/baselines/light/Solve.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace shoal::light::baselines {

using std::numbers::pi;

namespace {

constexpr size_t kRings = 5;
constexpr std::array<int, kRings> kCounts = {1, 5, 8, 10, 12};
static_assert(kCounts[0] + kCounts[1] + kCounts[2] + kCounts[3] + kCounts[4] == kFittedTaps);

// Levels below 16x8 are too coarse for the model: near the poles their texels are slivers.
constexpr double kWidestTexel = 0.4; // radians
constexpr double kHole = 0.5;        // least texel, as a part of what lies between a ring's taps

struct Rings {
    std::array<double, kRings> angle{}; // radians; the first stays 0
    std::array<double, kRings> weight{};
    double misfit = 1e30;
};

double texelOf(int lod, int baseWidth) { return 2 * pi / (baseWidth >> lod); }

// The finest level on which a ring's taps leave no holes between them; on a coarser one the result would
// depend on where the texels lie. The centre goes with the first ring, whose taps are about as far from each
// other as from it.
int lodOf(const Rings& rings, size_t ring, int baseWidth) {
    const size_t of = std::max<size_t>(ring, 1);
    const double spacing = 2 * pi * std::sin(rings.angle[of]) / kCounts[of];
    int lod = 0;
    while (texelOf(lod, baseWidth) < kHole * spacing) ++lod;
    return lod;
}

class Fit {
  public:
    Fit(double alpha, int baseWidth)
        : baseWidth_(baseWidth), alpha_(alpha),
          lobe_(zonalFactors([=](double cosine) { return math::ggxMirrorLobe(cosine, alpha); },
                             std::clamp(static_cast<int>(6 / alpha), 16, 300))) {}

    Rings best() const {
        Rings best;
        for (const double scale : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4}) {
            const Rings rings = descend(scale);
            if (rings.misfit < best.misfit) best = rings;
        }
        return best;
    }

  private:
    // Taps on rings where 80, 50, 25 and 8 % of a GGX distribution's energy are left outside, times scale.
    Rings descend(double scale) const {
        Rings rings;
        const double outside[] = {1, 0.8, 0.5, 0.25, 0.08};
        for (size_t k = 1; k < kRings; ++k)
            rings.angle[k] =
                scale * std::min(1.4, 2 * std::atan(alpha_ * std::sqrt((1 - outside[k]) / outside[k])));
        weigh(rings);
        for (bool better = true; better;) {
            better = false;
            for (size_t k = 1; k < kRings; ++k)
                for (const double stretch : {0.8, 0.9, 0.97, 1.03, 1.1, 1.25}) {
                    Rings other = rings;
                    other.angle[k] = std::min(other.angle[k] * stretch, 1.5);
                    weigh(other);
                    if (other.misfit < rings.misfit * (1 - 1e-9)) rings = other, better = true;
                }
        }
        return rings;
    }

    // Weights and misfit for given angles.
    void weigh(Rings& rings) const {
        rings.misfit = 1e30;
        const size_t bands = lobe_.size();
        std::vector<std::array<double, kRings>> answers(bands); // [l][k]: of a ring to band l
        for (size_t k = 0; k < kRings; ++k) {
            const double texel = texelOf(lodOf(rings, k, baseWidth_), baseWidth_);
            if (texel > kWidestTexel) return;
            double before = 0, now = 1;
            for (size_t l = 0; l < bands; ++l) {
                const auto band = static_cast<double>(l);
                answers[l][k] = now * std::exp(-band * (band + 1) * texel * texel / 8);
                const double next =
                    ((2 * band + 1) * std::cos(rings.angle[k]) * now - band * before) / (band + 1);
                before = now, now = next;
            }
        }

        // Rings that would weigh less than nothing are left out, the worst first.
        std::vector<size_t> used = {0, 1, 2, 3, 4};
        std::vector<double> weights;
        for (bool sound = false; !sound;) {
            weights = weightsOf(used, answers);
            const auto worst = std::min_element(weights.begin(), weights.end());
            sound = *worst >= 0;
            if (!sound) used.erase(used.begin() + (worst - weights.begin()));
            if (used.empty()) return;
        }
        double sum = 0;
        rings.weight.fill(0);
        for (size_t i = 0; i < used.size(); ++i) sum += rings.weight[used[i]] = weights[i];
        for (double& weight : rings.weight) weight /= sum;

        rings.misfit = 0;
        for (size_t l = 0; l < bands; ++l) {
            double off = -lobe_[l];
            for (size_t k = 0; k < kRings; ++k) off += rings.weight[k] * answers[l][k];
            rings.misfit += importance(l) * off * off;
        }
    }

    std::vector<double> weightsOf(const std::vector<size_t>& used,
                                  const std::vector<std::array<double, kRings>>& answers) const {
        const size_t count = used.size();
        std::vector<double> a(count * count), b(count);
        for (size_t l = 0; l < answers.size(); ++l)
            for (size_t i = 0; i < count; ++i) {
                const double weighed = importance(l) * answers[l][used[i]];
                for (size_t j = 0; j < count; ++j) a[i * count + j] += weighed * answers[l][used[j]];
                b[i] += weighed * lobe_[l];
            }
        for (size_t i = 0; i < count; ++i) a[i * count + i] *= 1 + 1e-12; // two rings may be alike
        solve(a, b, count);
        return b;
    }

    // Pictures have less power the finer they are: all of a band together about as 1 / l. The mean is kept.
    static double importance(size_t l) { return l ? 1.0 / static_cast<double>(l) : 1e3; }

    int baseWidth_;
    double alpha_;
    std::vector<double> lobe_;
};

} // namespace

std::vector<Tap> fittedTaps(float roughness, int baseWidth) {
    const Rings rings = Fit(math::alphaFromRoughness(roughness), baseWidth).best();
    std::vector<Tap> taps;
    for (size_t k = 0; k < kRings; ++k) {
        if (rings.weight[k] <= 0) continue;
        const double cosine = std::cos(rings.angle[k]), sine = std::sin(rings.angle[k]);
        for (int i = 0; i < kCounts[k]; ++i) {
            const double turn = (i + (k % 2 ? 0.5 : 0.0)) * (2 * pi / kCounts[k]);
            taps.push_back({glm::vec3(sine * std::cos(turn), sine * std::sin(turn), cosine),
                            static_cast<float>(lodOf(rings, k, baseWidth)),
                            static_cast<float>(rings.weight[k] / kCounts[k])});
        }
    }
    return taps;
}

} // namespace shoal::light::baselines
