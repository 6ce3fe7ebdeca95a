// Glossy light under occlusion.
#pragma once

#include "tests/bench/occlusion/Environment.h"

namespace shoal::bench {

constexpr float kGlossyRoughness = 0.25f; // of the smoothest surface in the game's dive

struct GlossyMeasured {
    std::string name;
    std::vector<double> errors; // [scene]: relative RMS over environments without point suns, equal weights
    std::vector<double> receiver_ns; // [scene]
};

struct GlossyChart {
    std::vector<double> noise; // [scene]: of the truth, the largest of any environment
    std::vector<GlossyMeasured> methods;
};

// Adds a scene to the chart.
void measureGlossy(GlossyChart& chart, const Scene& scene, const Rays& rays,
                   std::span<const Receiver> receivers, std::span<const LitEnvironment> environments);

} // namespace shoal::bench
