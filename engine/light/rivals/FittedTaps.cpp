#include "engine/light/rivals/FittedTaps.h"

#include "engine/light/rivals/Harmonics.h"
#include "engine/light/rivals/Solve.h"
#include "engine/math/Brdf.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace shoal::light::rivals {

using std::numbers::pi;

namespace {

constexpr size_t kRings = 4;
constexpr std::array<int, kRings> kCounts = {1, 6, 6, 8};
static_assert(kCounts[0] + kCounts[1] + kCounts[2] + kCounts[3] == kFittedTaps);

struct Rings {
    std::array<double, kRings> angle{}; // radians; the first stays 0
    std::array<int, kRings> lod{};
    std::array<double, kRings> weight{};
    double misfit = 1e30;
};

double texelOf(int lod, int baseWidth) { return 2 * pi / (baseWidth >> lod); }

class Fit {
  public:
    Fit(double alpha, int baseWidth)
        : baseWidth_(baseWidth), alpha_(alpha),
          lobe_(zonalFactors([=](double cosine) { return math::ggxMirrorLobe(cosine, alpha); },
                             std::clamp(static_cast<int>(6 / alpha), 16, 300))) {}

    Rings best() const {
        Rings rings;
        // Angles where the lobe has left 70, 35 and 10 % of a GGX distribution's energy outside.
        const double outside[] = {1, 0.7, 0.35, 0.1};
        for (size_t k = 1; k < kRings; ++k) {
            rings.angle[k] = std::min(1.2, 2 * std::atan(alpha_ * std::sqrt((1 - outside[k]) / outside[k])));
            rings.lod[k] = leastLod(k, rings.angle[k]);
        }
        rings.lod[0] = rings.lod[1];
        weigh(rings);
        for (bool better = true; better;) {
            better = false;
            for (size_t k = 0; k < kRings; ++k)
                for (const double stretch : {0.8, 0.9, 0.97, 1.0, 1.03, 1.1, 1.25})
                    for (int step = -2; step <= 2; ++step) {
                        Rings other = rings;
                        other.angle[k] = std::min(other.angle[k] * stretch, 1.5);
                        other.lod[k] += step;
                        weigh(other);
                        if (other.misfit < rings.misfit * (1 - 1e-9)) rings = other, better = true;
                    }
        }
        return rings;
    }

  private:
    // The level on which a ring's taps leave no holes between them.
    int leastLod(size_t ring, double angle) const {
        if (ring == 0) return 0;
        const double spacing = 2 * pi * std::sin(angle) / kCounts[ring];
        int lod = 0;
        while (texelOf(lod, baseWidth_) < 0.7 * spacing) ++lod;
        return lod;
    }

    // Weights and misfit for given angles and levels.
    void weigh(Rings& rings) const {
        rings.misfit = 1e30;
        for (size_t k = 0; k < kRings; ++k)
            if (rings.lod[k] < leastLod(k, rings.angle[k]) || texelOf(rings.lod[k], baseWidth_) > 1.6) return;
        std::vector<double> a(kRings * kRings), b(kRings);
        std::array<double, kRings> before{}, now, answers;
        now.fill(1);
        double squares = 0;
        const auto bands = static_cast<int>(lobe_.size());
        std::vector<std::array<double, kRings>> rows;
        for (int l = 0; l < bands; ++l) {
            for (size_t k = 0; k < kRings; ++k) {
                const double texel = texelOf(rings.lod[k], baseWidth_);
                answers[k] = now[k] * std::exp(-l * (l + 1.0) * texel * texel / 8);
                const double next =
                    ((2 * l + 1) * std::cos(rings.angle[k]) * now[k] - l * before[k]) / (l + 1);
                before[k] = now[k], now[k] = next;
            }
            rows.push_back(answers);
            for (size_t i = 0; i < kRings; ++i) {
                for (size_t j = 0; j < kRings; ++j)
                    a[i * kRings + j] += importance(l) * answers[i] * answers[j];
                b[i] += importance(l) * answers[i] * lobe_[static_cast<size_t>(l)];
            }
        }
        for (size_t i = 0; i < kRings; ++i) a[i * kRings + i] *= 1 + 1e-9;
        solve(a, b, kRings);
        double sum = 0;
        for (size_t k = 0; k < kRings; ++k) {
            if (b[k] < 0) return;
            sum += b[k];
        }
        for (size_t k = 0; k < kRings; ++k) rings.weight[k] = b[k] / sum;
        for (int l = 0; l < bands; ++l) {
            double off = -lobe_[static_cast<size_t>(l)];
            for (size_t k = 0; k < kRings; ++k) off += rings.weight[k] * rows[static_cast<size_t>(l)][k];
            squares += importance(l) * off * off;
        }
        rings.misfit = squares;
    }

    // Pictures have less power the finer they are: all of a band together about as 1 / l. The mean is kept.
    static double importance(int l) { return l ? 1.0 / l : 1e6; }

    int baseWidth_;
    double alpha_;
    std::vector<double> lobe_;
};

} // namespace

std::vector<Tap> fittedTaps(float roughness, int baseWidth) {
    const Rings rings = Fit(math::alphaFromRoughness(static_cast<double>(roughness)), baseWidth).best();
    std::vector<Tap> taps;
    for (size_t k = 0; k < kRings; ++k)
        for (int i = 0; i < kCounts[k]; ++i) {
            const double turn = (i + (k % 2 ? 0.5 : 0.0)) * (2 * pi / kCounts[k]);
            const double sine = std::sin(rings.angle[k]);
            taps.push_back({glm::vec3(sine * std::cos(turn), sine * std::sin(turn), std::cos(rings.angle[k])),
                            static_cast<float>(rings.lod[k]),
                            static_cast<float>(rings.weight[k] / kCounts[k])});
        }
    return taps;
}

} // namespace shoal::light::rivals
