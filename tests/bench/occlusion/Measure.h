// Measurements of every method over every scene and environment.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/occlusion/Glossy.h"
#include "tests/bench/occlusion/Method.h"
#include "tests/bench/occlusion/Truth.h"

namespace shoal::bench {

// Relative root mean square errors in one scene and environment; NaN: not measured.
struct SceneError {
    double all = 0;    // over all receivers
    double shaded = 0; // over receivers that lose a tenth of their light or more
};

struct OcclusionMeasured {
    OcclusionLabel label;
    OcclusionMethod::Moves moves = OcclusionMethod::Moves::Free;
    std::vector<std::vector<SceneError>> errors; // [scene][environment]
    std::vector<double> receiver_ns;             // [scene]
    std::vector<double> body_us;                 // [scene]: time to build its structures, for each body
    std::vector<size_t> bytes;                   // [scene]
};

struct OcclusionChart {
    std::vector<std::string> scenes, environments;
    std::vector<bool> pointSun;             // [environment]
    std::vector<std::vector<double>> noise; // [scene][environment]: of the truth
    std::vector<double> open;               // [scene]: mean free share of the hemisphere
    std::vector<OcclusionMeasured> methods; // the first ignores occlusion
    GlossyChart glossy;
};

OcclusionChart measureOcclusion(std::span<const Scene> scenes, const Path& shared, bool quick);

} // namespace shoal::bench
