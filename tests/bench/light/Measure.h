// Measurements of every method over every environment.
#pragma once

#include "engine/core/Image.h"
#include "tests/baselines/light/Baselines.h"
#include "tests/bench/light/Environments.h"
#include "tests/bench/light/Errors.h"
#include "tests/bench/light/LitBalls.h"
#include "tests/bench/light/Truth.h"

#include <string>
#include <vector>

namespace shoal::bench {

// Times on one core with warm caches, shortest of many runs, for a 2048x1024 frame.
struct Cost {
    double update_us = 0; // for each frame, with the pyramid if the method reads it
    double shade_ns = 0;  // a pixel
};

struct Measured {
    light::baselines::Label label;
    Cost cost;
    std::vector<std::vector<EnvironmentError>> errors; // [environment][lobe]; a diffuse method has one lobe
};

struct EnvironmentFact {
    std::string name;
    bool coded = false, pointSun = false;
};

constexpr float kReefRoughness = 0.25f; // of the smoothest surface in the game's dive

struct Chart {
    double read_us = 0;     // one plain read of the frame's bytes, compiled for any x86-64
    double wideRead_us = 0; // the same, compiled for the processor's widest registers
    double reef_us = 0;     // all light of a frame for the game's own surfaces
    double pyramid_us = 0;  // added to the cost of each method that reads it
    std::vector<EnvironmentFact> environments;
    std::vector<Measured> diffuse, glossy; // glossy lobes: kRoughnesses
    std::vector<Measured> pyramids;        // one lobe: the diffuse one; only coded environments count
    // Errors of two lobes (diffuse, roughness 0.5) over toneMapEnvironments: its first toneMapsClipped are
    // clippedSources(), the rest filmedSources().
    std::vector<Measured> toneMaps;
    size_t toneMapsClipped = 0;
    std::vector<std::string> toneMapEnvironments;
    LitBalls balls;
};

struct SessionConfig {
    Path shared, cache;
    int spread = 64; // directions besides the six axes
    bool quick = false;
};

// Measures the costs of all methods; the chart has their labels in the same order.
void timeMethods(Chart& chart, std::vector<light::baselines::DiffuseMethod>& diffuse,
                 std::vector<light::baselines::GlossyMethod>& glossy,
                 std::vector<light::baselines::PyramidMethod>& pyramids, bool quick);

// Fills toneMaps and toneMapEnvironments.
void measureToneMaps(Chart& chart, const SessionConfig& plan, std::span<const glm::dvec3> dirs);

// Measures the whole chart. Reports its progress on standard error.
Chart measure(const SessionConfig& plan);

} // namespace shoal::bench
