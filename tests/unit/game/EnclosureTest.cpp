// Enclosure of the video's places over the dive's time.
#include "Fixture.h"

#include <gtest/gtest.h>

namespace shoal::game {
namespace {

const std::vector<VideoMark> kEnclosures = {{10, 14, 0.5f}, {14, 20, 1}};

TEST(Enclosure, RisesBeforeAMarkStaysAndFades) {
    const auto at = [](double time_s) { return enclosureAt(kEnclosures, 60, time_s); };
    EXPECT_EQ(at(0), 0);
    EXPECT_EQ(at(8), 0);
    EXPECT_FLOAT_EQ(at(9), 0.25f);
    EXPECT_FLOAT_EQ(at(11), 0.5f);
    EXPECT_FLOAT_EQ(at(13.5), 0.75f); // the tunnel comes nearer
    EXPECT_FLOAT_EQ(at(14), 1);
    EXPECT_FLOAT_EQ(at(20), 1);
    EXPECT_FLOAT_EQ(at(21), 0.5f);
    EXPECT_EQ(at(22), 0);
}

TEST(Enclosure, FollowsTheVideoAroundItsEnd) {
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 60, 60 + 15), 1);
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 60, 120 + 9), 0.25f);
    const std::vector<VideoMark> atTheEnd = {{58, 60, 1}};
    EXPECT_FLOAT_EQ(enclosureAt(atTheEnd, 60, 61), 0.5f); // fades into the next pass
    const std::vector<VideoMark> atTheStart = {{0, 3, 1}};
    EXPECT_FLOAT_EQ(enclosureAt(atTheStart, 60, 59), 0.5f);
}

TEST(Enclosure, MarksOfALongerVideoAreNotHeard) {
    EXPECT_EQ(enclosureAt(kEnclosures, 6, 5.9), 0);
    EXPECT_EQ(enclosureAt(kEnclosures, 0, 15), 0); // no video
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 12, 11), 0.5f);
}

TEST(Enclosure, NeverJumps) {
    float before = enclosureAt(kEnclosures, 30, 0);
    for (int tick = 1; tick < 90 * 120; ++tick) {
        const float now = enclosureAt(kEnclosures, 30, tick / 120.0);
        ASSERT_LE(std::abs(now - before), 1.01f / 240); // all of it in two seconds
        before = now;
    }
}

TEST(Enclosure, TheSnapshotCarriesItAndARestartBeginsAnew) {
    DiveFile file = test::cove().dive;
    file.enclosure = {{1, 2, 1}};
    file.videoLength_s = 10;
    Dive dive(test::cove().species, file, 3);
    Snapshot now;
    Events events;
    for (int i = 0; i < 180; ++i) dive.step({}, events);
    dive.snapshot(now);
    EXPECT_EQ(now.enclosure, 1);
    TickInput again;
    again.restart = true;
    dive.step(again, events);
    dive.snapshot(now);
    EXPECT_NEAR(now.enclosure, 0.5f, 0.01f); // a second before the mark
    TickInput paused;
    paused.pause = true;
    for (int i = 0; i < 240; ++i) dive.step(paused, events);
    dive.snapshot(now);
    EXPECT_NEAR(now.enclosure, 0.5f, 0.01f);
}

TEST(Enclosure, TheShippedDiveHasATunnel) {
    const auto reef = loadDiveFiles("reef");
    ASSERT_TRUE(reef) << reef.error().message();
    float maximum = 0;
    for (const VideoMark& mark : reef->dive.enclosure) maximum = std::max(maximum, mark.amount);
    EXPECT_EQ(maximum, 1); // else its bed is never heard
}

} // namespace
} // namespace shoal::game
