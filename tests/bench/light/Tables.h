// What was measured, as text.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/light/Measure.h"

namespace shoal::bench {

Status writeMarkdown(const Chart& chart, const Path& folder); // chart.md, for people
Status writeCsv(const Chart& chart, const Path& folder);      // *.csv, for programs

} // namespace shoal::bench
