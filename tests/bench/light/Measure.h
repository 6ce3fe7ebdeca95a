// Every method over every environment.
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

// One core, warm, shortest of many, for a 2048x1024 frame.
struct Cost {
    double update_us = 0; // a frame, the pyramid included where the method reads it
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
    double wideRead_us = 0; // for the widest registers that the processor has
    double reef_us = 0;     // all light of a frame for the game's own surfaces
    double pyramid_us = 0;  // what those are charged with that read it
    std::vector<EnvironmentFact> environments;
    std::vector<Measured> diffuse, glossy; // glossy lobes: kRoughnesses
    std::vector<Measured> pyramids;        // one lobe: the diffuse one; only coded environments count
    // Two lobes: diffuse, roughness 0.5; over toneMapEnvironments: clippedSources(), the first
    // toneMapsClipped of them, then filmedSources().
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

// The costs of all methods in the chart, which has their labels in the same order.
void timeMethods(Chart& chart, std::vector<light::baselines::DiffuseMethod>& diffuse,
                 std::vector<light::baselines::GlossyMethod>& glossy,
                 std::vector<light::baselines::PyramidMethod>& pyramids, bool quick);

// Fills toneMaps and toneMapEnvironments.
void measureToneMaps(Chart& chart, const SessionConfig& plan, std::span<const glm::dvec3> dirs);

// All of it. Speaks of its progress on standard error.
Chart measure(const SessionConfig& plan);

} // namespace shoal::bench
