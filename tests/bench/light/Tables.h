// Writes the measurements as text.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/light/Measure.h"

namespace shoal::bench {

Status writeMarkdown(const Chart& chart, const Path& folder); // chart.md

} // namespace shoal::bench
