// The environments of the light's chart, in the forms that methods and the truth read.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/occlusion/Cells.h"
#include "tests/bench/occlusion/Method.h"

namespace shoal::bench {

struct LitEnvironment {
    Lit lit;
    Fine fine;
};
std::vector<LitEnvironment> litEnvironments(const Path& shared, bool quick);

// Returns the light of a frame of the game's video, in open water.
Result<Lit> reefLight();

} // namespace shoal::bench
