// Plays playthroughs without a display and prints the state hash that each ends with: playthrough_hashes
// FILE... Exits 1 if one does not meet its expectations.
#include "engine/core/Hash.h"
#include "tests/playthrough/MadeSpace.h"
#include "tests/playthrough/Play.h"

#include <cinttypes>
#include <cstdio>

using namespace shoal;

namespace {

Result<uint64_t> finalHash(const Path& file, const hands::HandRig& rig) {
    const auto script = game::loadScript(file);
    if (!script) return script.error();
    const auto files = game::loadDiveFiles(script->dive);
    if (!files) return files.error();
    const game::Played played = game::playScript(*script, rig, *files);
    if (!played.verdict) return played.verdict.error();
    // Of all ticks, so that states that part and meet again differ too.
    Hash all;
    for (size_t tick = 0; tick < played.recording.ticks(); ++tick) all.add(played.recording.hash(tick));
    return all.value();
}

// Of a dive in a tunnel that narrows and opens, with nobody there: what animals do in a film's space.
Result<uint64_t> hashInATunnel() {
    auto files = game::loadDiveFiles((dataRoot() / "tests/playthrough/dive/cove.toml").string());
    if (!files) return files.error();
    files->dive.space = game::breathingTunnel();
    game::Dive dive(files->species, files->dive, 7);
    game::Events events;
    Hash all;
    for (int tick = 0; tick < 60 * sim::kTickRate_Hz; ++tick) {
        events.clear();
        dive.step({}, events);
        all.add(dive.stateHash());
    }
    return all.value();
}

} // namespace

int main(int count, char** arguments) {
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) {
        std::fprintf(stderr, "%s\n", rig.error().message().c_str());
        return 1;
    }
    bool met = true;
    for (int i = 1; i < count; ++i) {
        const Path file = arguments[i];
        const auto hash = finalHash(file, *rig);
        if (hash)
            std::printf("%s %016" PRIx64 "\n", file.stem().c_str(), *hash);
        else
            std::fprintf(stderr, "%s: %s\n", file.c_str(), hash.error().message().c_str());
        met = met && hash;
    }
    const auto tunnel = hashInATunnel();
    if (tunnel) std::printf("in_a_tunnel %016" PRIx64 "\n", *tunnel);
    return met && tunnel ? 0 : 1;
}
