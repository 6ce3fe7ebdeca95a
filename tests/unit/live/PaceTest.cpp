#include "engine/media/live/Pace.h"
#include "engine/media/live/Backoff.h"

#include <gtest/gtest.h>

namespace shoal::media {
namespace {

constexpr double kFrame_s = 1 / 32.0; // exact in binary

TEST(Pace, WhatComesAtItsOwnRateNeverWaits) {
    Pace pace(0.05);
    for (int i = 0; i < 100000; ++i) EXPECT_EQ(pace.wait_s(i * kFrame_s, 7 + i * kFrame_s), 0);
}

TEST(Pace, ASendersClockMayRunAhead) {
    Pace pace(3);
    constexpr double kFaster = 1.0005; // half of a thousandth: ten times what quartz does
    for (int i = 0; i < 1000000; ++i) ASSERT_EQ(pace.wait_s(i * kFrame_s * kFaster, i * kFrame_s), 0) << i;
}

TEST(Pace, ABurstPassesWhereItMay) {
    Pace pace(3);
    for (int i = 0; i <= 96; ++i) EXPECT_EQ(pace.wait_s(i * kFrame_s, 0), 0) << i;
    EXPECT_GT(pace.wait_s(97 * kFrame_s, 0), 0);
}

// A file that comes as fast as it is read: who waits as told takes its own time over it.
TEST(Pace, AFileTakesItsOwnTime) {
    Pace pace(0.05);
    double now_s = 0;
    constexpr int kFrames = 3200;
    for (int i = 0; i <= kFrames; ++i) now_s += pace.wait_s(i * kFrame_s, now_s);
    // Ahead by the burst at most, and by the drift that is allowed.
    EXPECT_NEAR(now_s, kFrames * kFrame_s, 0.05 + 1e-3 * kFrames * kFrame_s);
    EXPECT_LE(now_s, kFrames * kFrame_s);
}

TEST(Pace, AfterAPauseNothingIsMadeUp) {
    Pace pace(0.05);
    double now_s = 0;
    for (int i = 0; i < 32; ++i) now_s += pace.wait_s(i * kFrame_s, now_s);
    now_s += 60;
    const double before_s = now_s;
    for (int i = 32; i < 64; ++i) now_s += pace.wait_s(i * kFrame_s, now_s);
    EXPECT_NEAR(now_s - before_s, 1, 0.05 + kFrame_s);
}

TEST(Pace, StampsThatJumpAreNotWaitedFor) {
    Pace pace(0.05);
    double now_s = 0;
    for (const double stamp_s : {0.0, 5e4, 1.0, 1.0 + kFrame_s, -3e5, 9e9}) {
        EXPECT_LT(pace.wait_s(stamp_s, now_s), kFrame_s);
        now_s += 1;
    }
}

TEST(Backoff, WaitsLongerEachTimeInVain) {
    Backoff backoff(0.5, 8);
    for (const double expected : {0.5, 1.0, 2.0, 4.0, 8.0, 8.0, 8.0}) EXPECT_EQ(backoff.next_s(), expected);
    backoff.succeeded();
    EXPECT_EQ(backoff.next_s(), 0.5);
}

} // namespace
} // namespace shoal::media
