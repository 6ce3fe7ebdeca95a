// Every script of this folder plays headless, meets its expectations at every display rate, and its recording
// replays tick for tick.
#include "engine/sim/FixedStep.h"
#include "tests/TestPaths.h"
#include "tests/playthrough/Play.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace shoal::game {
namespace {

std::vector<Path> scripts() {
    std::vector<Path> files;
    for (const auto& entry : std::filesystem::directory_iterator(dataRoot() / "tests/playthrough"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

// The same player before a display of that speed, which stumbles over a frame of 300 ms once.
std::pair<uint64_t, Status> playAt(int framesPerSecond, const Script& script, const DiveFiles& files,
                                   const hands::HandRig& rig) {
    Dive dive(files.species, files.dive, script.seed, script.rules);
    ScriptRun run(script, rig, files.species);
    sim::FixedStep clock;
    Snapshot before, now, shown;
    Events events;
    TickInput input;
    dive.snapshot(now);
    for (int frame = 0; !run.finished() && frame < 100'000; ++frame) {
        const int ticks = clock.advance(frame == framesPerSecond ? 0.3 : 1.0 / framesPerSecond);
        for (int i = 0; i < ticks && !run.finished(); ++i) {
            before = now;
            run.next(now, input);
            events.clear();
            dive.step(input, events);
            dive.snapshot(now);
            run.observe(events, now);
        }
        if (!before.creatures.empty()) interpolate(before, now, clock.alpha(), shown); // what a display does
    }
    return {dive.stateHash(), run.verdict()};
}

class Playthrough : public testing::TestWithParam<Path> {};

TEST_P(Playthrough, MeetsItsExpectationsAndReplays) {
    const auto script = loadScript(GetParam());
    ASSERT_TRUE(script) << script.error().message();
    const auto files = loadDiveFiles(script->dive);
    ASSERT_TRUE(files) << files.error().message();
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().message();

    std::string story;
    double sharkNear_s = -1e9;
    const auto watch = [&](const Snapshot& now, const Events& events) {
        for (const Event& event : events) {
            if (event.kind == EventKind::DiveStart) sharkNear_s = -1e9;
            if (event.kind == EventKind::SharkNear) sharkNear_s = now.time_s;
            // Nobody is taken by surprise: a second's notice, of this visit.
            if (event.kind == EventKind::SharkSteal || event.kind == EventKind::SharkBump) {
                EXPECT_GE(now.time_s - sharkNear_s, 1);
                EXPECT_LE(now.time_s - sharkNear_s, files->dive.shark.visitLength_s + 15);
            }
        }
        for (const Event& event : events)
            if (event.kind != EventKind::Touch && event.kind != EventKind::Startle)
                story += std::to_string(now.time_s) + " " + rowOf(event.kind).name + " hand " +
                         std::to_string(event.hand) + "\n";
    };
    const Played played = playScript(*script, *rig, *files, watch);
    if (std::getenv("SHOAL_STORY")) std::puts(story.c_str());
    EXPECT_TRUE(played.verdict) << played.verdict.error().message() << "\nwhat happened:\n" << story;
    ASSERT_GT(played.recording.ticks(), 0u);

    // Through the file, twice: the same state after every tick.
    const tests::ScratchFolder folder;
    const Path file = folder / "played.rec";
    const Status written = tests::write(file, played.recording);
    ASSERT_TRUE(written) << written.error().message();
    const auto read = tests::readRecorded(file);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->ticks(), played.recording.ticks());
    for (int round = 0; round < 2; ++round) {
        const Status same = replay(*read, *files);
        EXPECT_TRUE(same) << same.error().message();
    }
}

TEST_P(Playthrough, MeetsItsExpectationsAtEveryDisplayRate) {
    const auto script = loadScript(GetParam());
    ASSERT_TRUE(script) << script.error().message();
    const auto files = loadDiveFiles(script->dive);
    ASSERT_TRUE(files) << files.error().message();
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().message();
    std::optional<uint64_t> reference;
    for (int fps : {24, 30, 60, 90, 120, 144}) {
        const auto [hash, verdict] = playAt(fps, *script, *files, *rig);
        EXPECT_EQ(hash, reference.value_or(hash)) << fps << " frames a second";
        EXPECT_TRUE(verdict) << verdict.error().message() << " at " << fps << " frames a second";
        reference = hash;
    }
}

INSTANTIATE_TEST_SUITE_P(Scripts, Playthrough, testing::ValuesIn(scripts()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

} // namespace
} // namespace shoal::game
