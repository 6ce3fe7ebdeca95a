// Every script of this folder plays headless, meets its expectations, and its recording replays tick for
// tick.
#include "game/Playback.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shoal::game {
namespace {

std::vector<Path> scripts() {
    std::vector<Path> files;
    for (const auto& entry : std::filesystem::directory_iterator(Path(__FILE__).parent_path()))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class Playthrough : public testing::TestWithParam<Path> {};

TEST_P(Playthrough, MeetsItsExpectationsAndReplays) {
    const auto script = loadScript(GetParam());
    ASSERT_TRUE(script) << script.error().sentence();
    const auto files = loadDiveFiles(script->dive);
    ASSERT_TRUE(files) << files.error().sentence();
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().sentence();

    std::string story;
    double sharkNear_s = -1e9;
    const auto watch = [&](const Snapshot& now, const std::vector<Event>& events) {
        for (const Event& event : events) {
            if (event.kind == Event::Kind::DiveStart) sharkNear_s = -1e9;
            if (event.kind == Event::Kind::SharkNear) sharkNear_s = now.time_s;
            // Nobody is taken by surprise: a second's notice, of this visit.
            if (event.kind == Event::Kind::SharkSteal || event.kind == Event::Kind::SharkBump) {
                EXPECT_GE(now.time_s - sharkNear_s, 1);
                EXPECT_LE(now.time_s - sharkNear_s, files->dive.shark.visitLength_s + 15);
            }
        }
        for (const Event& event : events)
            if (event.kind != Event::Kind::Touch && event.kind != Event::Kind::Startle)
                story += std::to_string(now.time_s) + " " + kEventNames[static_cast<size_t>(event.kind)] +
                         " creature " + std::to_string(event.creature) + " hand " +
                         std::to_string(event.hand) + "\n";
    };
    const Played played = playScript(*script, *rig, *files, watch);
    if (std::getenv("SHOAL_STORY")) std::puts(story.c_str());
    EXPECT_TRUE(played.verdict) << played.verdict.error().sentence() << "\nwhat happened:\n" << story;
    ASSERT_GT(played.recording.ticks(), 0u);

    // Through the file, twice: the same state after every tick.
    const Path file = Path(testing::TempDir()) / ("shoal_" + GetParam().stem().string() + ".rec");
    const Status written = sim::writeRecording(file, played.recording);
    ASSERT_TRUE(written) << written.error().sentence();
    const auto read = sim::readRecording(file);
    ASSERT_TRUE(read) << read.error().sentence();
    EXPECT_EQ(read->ticks(), played.recording.ticks());
    for (int round = 0; round < 2; ++round) {
        const Status same = replay(*read, *files);
        EXPECT_TRUE(same) << same.error().sentence();
    }
    std::filesystem::remove(file);
}

INSTANTIATE_TEST_SUITE_P(Scripts, Playthrough, testing::ValuesIn(scripts()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

} // namespace
} // namespace shoal::game
