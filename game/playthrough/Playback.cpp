#include "game/playthrough/Playback.h"

namespace shoal::game {

Result<DiveFiles> loadDiveFiles(const std::string& name, const Path& content) {
    const bool isFile = name.ends_with(".toml");
    const Path root = content.empty() ? dataRoot() / "content" : content;
    const Path file = isFile ? Path(name) : root / "dives" / (name + ".toml");
    auto species = loadSpecies((isFile ? file.parent_path() : root) / "species.toml");
    if (!species) return species.error();
    auto dive = loadDive(file, *species);
    if (!dive) return dive.error();
    dive->name = name; // by which a recording finds it again
    return DiveFiles{*std::move(species), *std::move(dive)};
}

sim::RecordingHeader headerFor(const Dive& dive, std::map<std::string, std::string> settings) {
    sim::RecordingHeader header;
    header.seed = dive.seed();
    header.dive = dive.file().name;
    header.settings = std::move(settings);
    header.inputBytes = kTickInputBytes;
    return header;
}

Played playScript(const Script& script, const hands::HandRig& rig, const DiveFiles& files,
                  const Watch& watch) {
    Dive dive(files.species, files.dive, script.seed);
    ScriptRun run(script, rig, files.species);
    Played played{sim::Recording(headerFor(dive, {{"script", script.name}})), Done{}, {}};
    std::array<uint8_t, kTickInputBytes> bytes;
    std::vector<Event> events;
    TickInput input;
    dive.snapshot(played.end);
    const auto maximum = static_cast<uint64_t>((script.timeout_s + 1) * sim::kTickRate_Hz);
    while (!run.finished() && run.ticks() < maximum) {
        run.next(played.end, input);
        events.clear();
        dive.step(input, events);
        dive.snapshot(played.end);
        run.observe(events, played.end);
        toBytes(input, bytes);
        played.recording.add(bytes, dive.stateHash());
        if (watch) watch(played.end, events);
    }
    played.verdict = run.verdict();
    return played;
}

Status replay(const sim::Recording& recording, const DiveFiles& files, const Watch& watch) {
    if (recording.header().inputBytes != kTickInputBytes)
        return Error{"", "the recording is of another version of the game"};
    if (recording.header().dive != files.dive.name)
        return Error{"", "the recording is of the dive \"" + recording.header().dive + "\""};
    Dive dive(files.species, files.dive, recording.header().seed);
    std::vector<Event> events;
    Snapshot snapshot;
    for (size_t tick = 0; tick < recording.ticks(); ++tick) {
        events.clear();
        dive.step(fromBytes(recording.input(tick).first<kTickInputBytes>()), events);
        if (auto same = recording.compare(tick, dive.stateHash()); !same) return same;
        if (!watch) continue;
        dive.snapshot(snapshot);
        watch(snapshot, events);
    }
    return Done{};
}

} // namespace shoal::game
