// Playing scripts and recordings without a display.
#pragma once

#include "engine/sim/Recording.h"
#include "game/playthrough/Script.h"

#include <functional>

namespace shoal::game {

// A dive and its species. dive: a name, for dives/NAME.toml and species.toml below content
// (dataRoot()/content if empty); or the path of a dive file, NAME.toml, beside which lies its species.toml.
Result<DiveFiles> loadDiveFiles(const std::string& dive, const Path& content = {});

// Runs a script against a new dive until it has finished. watch, if given, sees every tick. The recording
// holds all of it; its header names script and dive. Ends after script.timeout_s at the latest.
struct Played {
    sim::Recording recording;
    Status verdict;
    Snapshot end;
};
using Watch = std::function<void(const Snapshot&, const std::vector<Event>&)>;
Played playScript(const Script&, const hands::HandRig&, const DiveFiles&, const Watch& watch = {});

// Header for a recording of this dive.
sim::RecordingHeader headerFor(const Dive&, std::map<std::string, std::string> settings = {});

// Steps a new dive through the recording; fails at the first tick whose state differs.
Status replay(const sim::Recording&, const DiveFiles&, const Watch& watch = {});

} // namespace shoal::game
