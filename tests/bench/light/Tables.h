// What was measured, as text: chart.md for people, *.csv for programs.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/light/Measure.h"

namespace shoal::bench {

constexpr double kGlossyPixels = 100000; // shaded in a frame, for one figure of a glossy method's cost

// Which of the surrounds and lobes a figure stands for.
enum class Suns { With, Without, Only };
Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes);

// Microseconds a frame with so many pixels shaded.
double frame_us(const Cost& cost, double pixels);

Status writeTables(const Chart& chart, const Path& folder);

} // namespace shoal::bench
