// Real, orthonormal spherical harmonics of any number of bands up to kMaxBands, polar axis up, longitude as
// in the lat-long map: there a sum over texels falls into sums over rows and one over columns.
#pragma once

#include "engine/core/Image.h"
#include "tests/baselines/light/Reference.h"

#include <glm/vec3.hpp>

#include <array>
#include <functional>
#include <vector>

namespace shoal::light::baselines {

constexpr int kMaxBands = 8;
constexpr int kMaxHarmonics = kMaxBands * kMaxBands;

// Index of Y_lm: l (l + 1) + m.
using HarmonicRgb = std::array<glm::vec3, kMaxHarmonics>;

class Harmonics {
  public:
    explicit Harmonics(int bands);

    int bands() const { return bands_; }

    // Y_lm of a direction (unit length, env frame), for each l < bands().
    void evaluate(const glm::vec3& dir, std::array<float, kMaxHarmonics>& out) const;

  private:
    // Factors of the recurrence P_lm = raise (z P_(l-1)m - drop P_(l-2)m) of normalised Legendre functions
    // without their factor sin^m.
    int bands_;
    std::array<float, kMaxHarmonics> raise_{}, drop_{}; // [l * kMaxBands + m]
    std::array<float, kMaxBands> first_{};              // P_mm, for m > 0 times sqrt(2)
};

// Integrals of radiance times Y_lm over a level of the pyramid.
class HarmonicProjection {
  public:
    HarmonicProjection(int width, int bands);

    void project(const ImageRgbF& level, HarmonicRgb& out);

  private:
    static constexpr int kLanes = 2 * kMaxBands; // cosines of m = 0 .. 7, then sines

    int width_, bands_;
    std::vector<float> turns_; // [column][lane]
    std::vector<float> rows_;  // [row][l * kMaxBands + m]: integral of Y_lm, but for its longitude
};

// Factors of the bands for a convolution with a lobe whose integral is 1: integral of lobe P_l over that of
// the lobe. Ramamoorthi and Hanrahan's A_l / pi for the clamped cosine.
std::vector<double> zonalFactors(const std::function<double(double cosine)>& lobe, int bands);

} // namespace shoal::light::baselines
