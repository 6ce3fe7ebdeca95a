// The video's ground, by the dive's own time.
#include "Fixture.h"

#include <gtest/gtest.h>

namespace shoal::game {
namespace {

const std::vector<VideoMark> kGroundMarks = {{10, 14, -1.2f}, {15, 20, -1.4f}, {40, 50, -1}};

TEST(Ground, IsThereWithinMarksAndFadesAround) {
    const auto at = [](double time_s) { return groundAt(kGroundMarks, 60, time_s); };
    EXPECT_EQ(at(5).presence, 0);
    EXPECT_FLOAT_EQ(at(9).presence, 0.5f);
    EXPECT_FLOAT_EQ(at(9).height_m, -1.2f);
    EXPECT_FLOAT_EQ(at(12).presence, 1);
    EXPECT_FLOAT_EQ(at(14.5).presence, 0.75f);
    EXPECT_FLOAT_EQ(at(14.5).height_m, -1.3f);
    EXPECT_FLOAT_EQ(at(18).height_m, -1.4f);
    EXPECT_EQ(at(30).presence, 0);
    EXPECT_FLOAT_EQ(at(60 + 45).height_m, -1);
}

TEST(Ground, OfAnotherVideoIsNotKnown) {
    EXPECT_EQ(groundAt(kGroundMarks, 0, 12).presence, 0);
    EXPECT_EQ(groundAt({}, 60, 12).presence, 0);
}

TEST(Ground, NeverJumps) {
    Ground before = groundAt(kGroundMarks, 60, 0);
    for (int tick = 1; tick < 120 * 120; ++tick) {
        const Ground now = groundAt(kGroundMarks, 60, tick / 120.0);
        ASSERT_LE(std::abs(now.presence - before.presence), 1.01f / 240);
        if (before.presence > 0 && now.presence > 0) {
            ASSERT_LE(std::abs(now.height_m - before.height_m), 0.001f);
        }
        before = now;
    }
}

TEST(Ground, TheSnapshotCarriesIt) {
    DiveFile file = test::cove().dive;
    file.ground = {{0, 2, -1.3f}};
    file.videoLength_s = 10;
    Dive dive(test::cove().species, file, 3);
    Snapshot now;
    dive.snapshot(now);
    EXPECT_EQ(now.ground.presence, 1);
    EXPECT_EQ(now.ground.height_m, -1.3f);
}

} // namespace
} // namespace shoal::game
