// The true light of an environment.
#pragma once

#include "tests/baselines/light/Reference.h"
#include "tests/bench/Bench.h"

namespace shoal::bench {

constexpr float kRoughnesses[] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.8f, 1.0f};

// Returns directions spread evenly over the sphere (Fibonacci lattice), then the six axes: both poles, the
// seam, ahead, left and right.
std::vector<glm::dvec3> chartDirections(int spread);

// [direction][lobe]
using Truth = std::vector<std::vector<glm::dvec3>>;

inline std::vector<glm::dvec3> column(const Truth& truth, size_t lobe) {
    std::vector<glm::dvec3> values;
    for (const auto& row : truth) values.push_back(row[lobe]);
    return values;
}

// Returns light::referenceRadiance() over every texel, computed on all cores.
Truth integrals(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs,
                std::span<const light::Lobe> lobes);

// Returns the diffuse lobe, then those of kRoughnesses.
Truth truthOf(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs);

} // namespace shoal::bench
