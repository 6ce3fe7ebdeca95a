// What is to be played: dive, seed, and who plays it.
#pragma once

#include "engine/sim/Recording.h"
#include "game/DiveFile.h"
#include "game/Script.h"
#include "game/app/Options.h"
#include "input/hands/HandRig.h"

#include <optional>

namespace shoal::app {

// What the files and the command line say, before any device is opened.
struct Plan {
    game::SpeciesTable species;
    game::DiveFile dive;
    hands::HandRig rig;
    uint64_t seed = 1;
    bool openXrHands = false; // a headset's
    HandOptions hands;        // of the person who plays, where no script or replay does
    bool live = true;         // somebody looks on: time is the clock's
    std::optional<game::Script> script;
    std::optional<sim::Recording> replay;
};

// Reads the files that the options name. A script or replay brings its own dive and seed.
Result<Plan> makePlan(const PlayOptions& options);

} // namespace shoal::app
