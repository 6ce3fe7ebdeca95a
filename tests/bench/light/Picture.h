// Data that chart.gp draws: points, their names placed without overlap, and the Pareto front.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/light/Measure.h"

namespace shoal::bench {

// The size of one panel's plot in a picture 900 pixels wide; chart.gp places it so.
constexpr double kPanelWidth = 810, kPanelHeight = 430;

Status writePicture(const Chart& chart, const Path& folder);

} // namespace shoal::bench
