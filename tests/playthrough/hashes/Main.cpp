// Plays playthroughs without a display, in open water and in the rooms of their films, and prints each one's
// name and the hashes of all its states in both: playthrough_hashes FILE... Exits 1 if one does not meet its
// expectations.
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"

#include <cinttypes>
#include <cstdio>

using namespace shoal;

namespace {

Result<uint64_t> hashOf(const Path& file, bool inFilm) {
    const auto dive = game::loadScriptedDive(file, inFilm);
    if (!dive) return dive.error();
    const game::Played played = game::playScript(dive->script, tests::rig(), dive->files);
    if (!played.verdict)
        return Error{inFilm ? "in the room of its film" : "in open water", played.verdict.error().message()};
    return played.hash;
}

} // namespace

int main(int count, char** arguments) {
    bool met = true;
    for (int i = 1; i < count; ++i) {
        const Path file = arguments[i];
        const auto open = hashOf(file, false), film = hashOf(file, true);
        if (open && film)
            std::printf("%s %016" PRIx64 " %016" PRIx64 "\n", file.stem().c_str(), *open, *film);
        for (const auto& hash : {open, film})
            if (!hash) std::fprintf(stderr, "%s: %s\n", file.c_str(), hash.error().message().c_str());
        met = met && open && film;
    }
    return met ? 0 : 1;
}
