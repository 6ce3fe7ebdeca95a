// Every script of this folder plays headless, in open water and in the room of its film; meets its
// expectations, gives the states stored in tests/equal_hashes.txt, and its recording replays tick for tick.
#include "tests/Test.h"
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"

namespace shoal::game {
namespace {

std::vector<Path> scripts() {
    std::vector<Path> files;
    for (const auto& entry : std::filesystem::directory_iterator(dataRoot() / "tests/playthrough"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class Playthrough : public testing::TestWithParam<std::tuple<Path, bool>> {};

TEST_P(Playthrough, MeetsItsExpectationsAndReplays) {
    const auto& [file, inFilm] = GetParam();
    const auto setup = tests::valueOf(loadScriptedDive(file, inFilm));
    std::string story;
    double sharkNear_s = -1e9;
    const auto watch = [&](const Snapshot& now, const Events& events) {
        for (const Event& event : events) {
            if (event.kind == EventKind::DiveStart) sharkNear_s = -1e9;
            if (event.kind == EventKind::SharkNear) sharkNear_s = now.time_s;
            // The shark gives a second's notice in each visit.
            if (event.kind == EventKind::SharkSteal || event.kind == EventKind::SharkBump) {
                EXPECT_GE(now.time_s - sharkNear_s, 1);
                EXPECT_LE(now.time_s - sharkNear_s, setup.files.dive.shark.visitLength_s + 15);
            }
            if (event.kind != EventKind::Touch && event.kind != EventKind::Startle)
                story += std::to_string(now.time_s) + " " + rowOf(event.kind).name + " hand " +
                         std::to_string(event.hand) + "\n";
        }
    };
    const Played played = playScript(setup.script, tests::rig(), setup.files, watch);
    if (std::getenv("SHOAL_STORY")) std::puts(story.c_str());
    EXPECT_TRUE(played.verdict) << played.verdict.error().message() << "\nwhat happened:\n" << story;
    EXPECT_EQ(played.hash, storedHash(file.stem(), inFilm)) << "tests/equal_hashes --update stores it anew";
    ASSERT_GT(played.recording.ticks(), 0u);

    // The same state after every tick, through the file.
    const tests::ScratchFolder folder;
    const Path recording = folder / "played.rec";
    ASSERT_TRUE(tests::succeeded(tests::write(recording, played.recording)));
    const auto read = tests::valueOf(tests::readRecorded(recording));
    EXPECT_EQ(read.ticks(), played.recording.ticks());
    EXPECT_TRUE(tests::succeeded(replay(read, setup.files)));
}

INSTANTIATE_TEST_SUITE_P(Scripts, Playthrough,
                         testing::Combine(testing::ValuesIn(scripts()), testing::Bool()),
                         [](const auto& parameter) {
                             return std::get<0>(parameter.param).stem().string() +
                                    (std::get<1>(parameter.param) ? "InItsFilm" : "InOpenWater");
                         });

TEST(Playthroughs, ExpectEveryEvent) {
    std::set<EventKind> expected;
    for (const Path& file : scripts()) {
        const auto script = tests::valueOf(loadScript(file));
        for (const ScriptExpect& expect : script.expects) {
            if (expect.event) expected.insert(*expect.event);
            expected.insert(expect.order.begin(), expect.order.end());
        }
    }
    for (const EventRow& row : kEventRows)
        EXPECT_TRUE(expected.contains(row.kind)) << "no playthrough expects \"" << row.name << '"';
}

} // namespace
} // namespace shoal::game
