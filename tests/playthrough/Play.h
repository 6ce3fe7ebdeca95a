// Playing scripts and recordings without a display, as fast as the processor can.
#pragma once

#include "game/playthrough/Script.h"
#include "tests/Recorded.h"
#include "tests/playthrough/Rooms.h"

#include <functional>
#include <sstream>

namespace shoal::game {

// A script and the files of its dive.
struct ScriptedDive {
    Script script;
    DiveFiles files;
};

// Loads a script and its dive. inFilm: true for the room of its film, false for open water.
inline Result<ScriptedDive> loadScriptedDive(const Path& file, bool inFilm) {
    const auto script = loadScript(file);
    if (!script) return script.error();
    auto files = loadDiveFiles(*script);
    if (!files) return files.error();
    if (inFilm)
        if (Status found = roomOf(files->dive.video).moveTo(files->dive.space); !found) return found.error();
    return ScriptedDive{*script, *std::move(files)};
}

// Returns the hash of all states of a playthrough that tests/equal_hashes.txt holds; 0: it holds none. Its
// lines are "NAME OPEN FILM": the hashes in open water, and in the room of the film.
inline uint64_t storedHash(const std::string& name, bool inFilm) {
    std::istringstream lines(readText(dataRoot() / "tests/equal_hashes.txt").value());
    std::string word, open, film;
    while (lines >> word >> open >> film)
        if (word == name) return std::stoull(inFilm ? film : open, nullptr, 16);
    return 0;
}

struct Played {
    tests::Recorded recording;
    Status verdict;
    Snapshot end;
    uint64_t hash = 0; // hash of all states
};
// Functions that are called after every tick; both may be empty.
using Watch = std::function<void(const Snapshot&, const Events&)>;
using StateWatch = std::function<void(const DiveState&, const Events&)>;

// Runs a script against a new dive until it has finished, after script.timeout_s at the latest.
inline Played playScript(const Script& script, const hands::HandRig& rig, const DiveFiles& files,
                         const Watch& watch = {}, const StateWatch& stateWatch = {}) {
    Dive dive(files.species, files.dive, script.seed, script.rules);
    ScriptRun run(script, rig, files.species, files.dive.space != nullptr);
    Played played{tests::Recorded(recordingHeader(dive)), Done{}, {}, 0};
    std::array<uint8_t, kTickInputBytes> bytes;
    Events events;
    TickInput input;
    dive.snapshot(played.end);
    const auto maximum = static_cast<uint64_t>((script.timeout_s + 1) * sim::kTickRate_Hz);
    while (!run.finished() && run.ticks() < maximum) {
        run.next(played.end, input);
        events.clear();
        dive.step(input, events);
        dive.snapshot(played.end);
        const uint64_t hash = dive.stateHash();
        run.observe(events, hash, played.end);
        toBytes(input, bytes);
        played.recording.add(bytes, hash);
        if (watch) watch(played.end, events);
        if (stateWatch) stateWatch(dive.state(), events);
    }
    played.verdict = run.verdict();
    played.hash = run.hash();
    return played;
}

// Steps a new dive through the recording; fails at the first tick whose state differs.
inline Status replay(const tests::Recorded& recording, const DiveFiles& files, const Watch& watch = {}) {
    if (recording.header().dive != files.dive.name)
        return Error{"", "the recording is of another dive or version of the game"};
    const auto rules = rulesOf(recording.header());
    if (!rules) return rules.error();
    if (auto space = checkFilmSpace(recording.header(), files.dive.space.get()); !space) return space;
    Dive dive(files.species, files.dive, recording.header().seed, *rules);
    Events events;
    Snapshot snapshot;
    for (size_t tick = 0; tick < recording.ticks(); ++tick) {
        events.clear();
        dive.step(tests::inputAt(recording, tick), events);
        if (auto same = sim::sameState(tick, recording.hash(tick), dive.stateHash()); !same) return same;
        if (!watch) continue;
        dive.snapshot(snapshot);
        watch(snapshot, events);
    }
    return Done{};
}

} // namespace shoal::game
