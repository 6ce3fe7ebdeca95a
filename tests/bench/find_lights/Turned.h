// How surely lights are found: pictures whose light is known, turned and exposed at random.
#pragma once

#include "tests/bench/light/Environments.h"

namespace shoal::bench {

// Prints a row for each picture: its strongest light, how far the truth itself moves with the window that one
// looks through, how far from it the light is found in `count` turned and clipped frames, and how large.
void turnedTable(const std::vector<EnvironmentSource>& pictures, int count);

} // namespace shoal::bench
