// Plays playthroughs without a display, in open water and in the rooms of their films, and prints each one's
// name and the hashes of all its states in both: playthrough_hashes FILE... Exits 1 if one does not meet its
// expectations.
#include "tests/playthrough/Play.h"
#include "tests/playthrough/Rooms.h"

#include <cinttypes>
#include <cstdio>

using namespace shoal;

namespace {

Result<std::array<uint64_t, 2>> hashesOf(const Path& file, const hands::HandRig& rig) {
    const auto script = game::loadScript(file);
    if (!script) return script.error();
    auto files = game::loadDiveFiles(*script);
    if (!files) return files.error();
    const auto room = game::roomOf(files->dive.video);
    if (!room) return room.error();
    std::array<uint64_t, 2> hashes{};
    for (size_t i = 0; i < hashes.size(); ++i) {
        files->dive.space = i == 0 ? nullptr : *room;
        const game::Played played = game::playScript(*script, rig, *files);
        if (!played.verdict)
            return Error{i == 0 ? "in open water" : "in the room of its film",
                         played.verdict.error().message()};
        hashes[i] = played.hash;
    }
    return hashes;
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
        const auto hashes = hashesOf(file, *rig);
        if (hashes)
            std::printf("%s %016" PRIx64 " %016" PRIx64 "\n", file.stem().c_str(), (*hashes)[0],
                        (*hashes)[1]);
        else
            std::fprintf(stderr, "%s: %s\n", file.c_str(), hashes.error().message().c_str());
        met = met && hashes;
    }
    return met ? 0 : 1;
}
