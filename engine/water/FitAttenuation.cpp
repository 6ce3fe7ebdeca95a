#include "engine/water/FitAttenuation.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::water {

namespace {

constexpr float kPriorMean_perM = 0.13f;
constexpr float kPriorSpread = 0.35f;   // of its logarithm
constexpr float kRatioSpread = 0.25f;   // likewise of a channel's ratio to the mean
constexpr float kMaxGreenToBlue = 1.8f; // bound of their ratio and of its inverse
constexpr float kHorizonWeight = 0.1f;  // of the veil at the horizon, relative to the whole floor
constexpr float kModelError = 0.03f;    // standard deviation of the model, of the brightest sample
constexpr float kEffectiveSamples = 6;  // independent observations that the floor is worth

constexpr size_t kGrid = 64;
using Grid = std::array<double, kGrid>;

double logAttenuation(size_t g) {
    static const double low = std::log(static_cast<double>(kMinAttenuation_perM)),
                        high = std::log(static_cast<double>(kMaxAttenuation_perM));
    return low + (high - low) * static_cast<double>(g) / (kGrid - 1);
}

double normal(double x, double spread) { return std::exp(-0.5 * x * x / (spread * spread)); }

// Weighted second moments of the basis functions of floor (J) and veil (B) and of the observation (y).
struct Moments {
    double jj = 0, jb = 0, bb = 0, jy = 0, by = 0, yy = 0;

    void add(double weight, double j, double b, double y) {
        jj += weight * j * j, jb += weight * j * b, bb += weight * b * b;
        jy += weight * j * y, by += weight * b * y, yy += weight * y * y;
    }

    // Mean square residual of the best J, B >= 0.
    double residual() const {
        const double det = jj * bb - jb * jb;
        if (det > 1e-12 * jj * bb) {
            const double floor = (jy * bb - by * jb) / det, veil = (by * jj - jy * jb) / det;
            if (floor >= 0 && veil >= 0) return std::max(0.0, yy - floor * jy - veil * by);
        }
        return std::max(0.0, yy - std::max(jj > 0 ? jy * jy / jj : 0, bb > 0 ? by * by / bb : 0));
    }
};

// Likelihood of one channel's samples for each attenuation of the grid, scaled to a maximum of 1.
Grid likelihood(std::span<const FloorSample> samples, double weights, int channel, double veil) {
    Grid residual{};
    double brightest = veil, best = 1e300;
    for (const FloorSample& sample : samples)
        brightest = std::max(brightest, static_cast<double>(sample.lightLin[channel]));
    for (size_t g = 0; g < kGrid; ++g) {
        const double attenuation = std::exp(logAttenuation(g));
        Moments moments;
        for (const FloorSample& sample : samples) {
            const double transmitted = std::exp(-attenuation * static_cast<double>(sample.distance_m));
            moments.add(static_cast<double>(sample.weight) / weights, transmitted, 1 - transmitted,
                        static_cast<double>(sample.lightLin[channel]));
        }
        moments.add(static_cast<double>(kHorizonWeight), 0, 1, veil);
        residual[g] = moments.residual();
        best = std::min(best, residual[g]);
    }
    const double misfit = static_cast<double>(kModelError) * brightest;
    const double variance = best + misfit * misfit;
    for (double& value : residual)
        value = variance > 0
                    ? std::exp(-0.5 * static_cast<double>(kEffectiveSamples) * (value - best) / variance)
                    : 1;
    return residual;
}

// Prior ratios of the channels' attenuation to their geometric mean.
glm::vec3 priorRatios(const glm::vec3& veilLin) {
    constexpr float kRed = 1.6f; // of every water clear enough to dive in, within a fifth
    const float greenToBlue = std::sqrt(std::max(veilLin.z, 1e-4f) / std::max(veilLin.y, 1e-4f));
    const float root = std::sqrt(std::clamp(greenToBlue, 1 / kMaxGreenToBlue, kMaxGreenToBlue));
    return {kRed, root / std::sqrt(kRed), 1 / (root * std::sqrt(kRed))};
}

} // namespace

glm::vec3 priorAttenuation(const glm::vec3& veilLin) { return kPriorMean_perM * priorRatios(veilLin); }

glm::vec3 fitAttenuation(std::span<const FloorSample> samples, const glm::vec3& veilLin) {
    double weights = 0;
    for (const FloorSample& sample : samples) weights += static_cast<double>(sample.weight);
    if (weights <= 0) return priorAttenuation(veilLin);

    // For each channel, given the mean attenuation at grid point s: evidence and posterior mean of ln beta.
    std::array<Grid, 3> evidence, mean;
    const glm::vec3 ratios = priorRatios(veilLin);
    for (int c = 0; c < 3; ++c) {
        const Grid likelihoods = likelihood(samples, weights, c, static_cast<double>(veilLin[c]));
        std::array<double, 2 * kGrid - 1>
            ratioPrior; // prior of a channel `i - kGrid + 1` points above the mean
        const double step = logAttenuation(1) - logAttenuation(0);
        for (size_t i = 0; i < ratioPrior.size(); ++i)
            ratioPrior[i] = normal((static_cast<double>(i) - (kGrid - 1)) * step -
                                       std::log(static_cast<double>(ratios[c])),
                                   static_cast<double>(kRatioSpread));
        for (size_t s = 0; s < kGrid; ++s) {
            double sum = 0, moment = 0;
            for (size_t g = 0; g < kGrid; ++g) {
                const double p = likelihoods[g] * ratioPrior[g + kGrid - 1 - s];
                sum += p;
                moment += p * logAttenuation(g);
            }
            evidence[static_cast<size_t>(c)][s] = sum;
            mean[static_cast<size_t>(c)][s] = sum > 0 ? moment / sum : 0;
        }
    }
    double total = 0;
    glm::dvec3 sum(0);
    for (size_t s = 0; s < kGrid; ++s) {
        const double p = normal(logAttenuation(s) - std::log(static_cast<double>(kPriorMean_perM)),
                                static_cast<double>(kPriorSpread)) *
                         evidence[0][s] * evidence[1][s] * evidence[2][s];
        total += p;
        sum += p * glm::dvec3(mean[0][s], mean[1][s], mean[2][s]);
    }
    if (!(total > 0)) return priorAttenuation(veilLin);
    return glm::vec3(glm::exp(sum / total));
}

} // namespace shoal::water
