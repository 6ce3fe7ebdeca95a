// Configuration of a session: dive, seed and source of input.
#pragma once

#include "engine/sim/Recording.h"
#include "game/playthrough/Script.h"
#include "game/rules/DiveFile.h"
#include "game/settings/PlayOptions.h"
#include "input/hands/HandRig.h"

#include <optional>

namespace shoal::app {

struct SessionConfig {
    game::SpeciesTable species;
    game::DiveFile dive;
    hands::HandRig rig;
    uint64_t seed = 1;
    HandSourceChoice handSource;
    HandOptions hands; // of the tracking devices
    bool live = true;  // in real time, for somebody who looks on
    std::optional<game::Script> script;
    std::optional<sim::Recording> replay;
};

// Reads the files that the options name. A script or replay brings its own dive and seed.
Result<SessionConfig> makeSessionConfig(const PlayOptions& options);

} // namespace shoal::app
