#include "engine/media/live/PacketQueue.h"

#include <gtest/gtest.h>

namespace shoal::media {
namespace {

constexpr double kFrame_s = 1 / 32.0; // exact in binary

TEST(TokenBucket, AStreamAtItsOwnRateNeverWaits) {
    TokenBucket bucket(0.05);
    for (int i = 0; i < 100000; ++i) EXPECT_EQ(bucket.wait_s(i * kFrame_s, 7 + i * kFrame_s), 0);
}

TEST(TokenBucket, ASendersClockMayRunAhead) {
    TokenBucket bucket(3);
    constexpr double kFaster = 1.0005; // half of a thousandth: ten times what quartz does
    for (int i = 0; i < 1000000; ++i) ASSERT_EQ(bucket.wait_s(i * kFrame_s * kFaster, i * kFrame_s), 0) << i;
}

TEST(TokenBucket, ABurstPassesWhereItMay) {
    TokenBucket bucket(3);
    for (int i = 0; i <= 96; ++i) EXPECT_EQ(bucket.wait_s(i * kFrame_s, 0), 0) << i;
    EXPECT_GT(bucket.wait_s(97 * kFrame_s, 0), 0);
}

// Waiting as the bucket says plays a file at its own rate, though it arrives as fast as it is read.
TEST(TokenBucket, AFileTakesItsOwnTime) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    constexpr int kFrames = 3200;
    for (int i = 0; i <= kFrames; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    // Ahead by the burst at most, and by the drift that is allowed.
    EXPECT_NEAR(now_s, kFrames * kFrame_s, 0.05 + 1e-3 * kFrames * kFrame_s);
    EXPECT_LE(now_s, kFrames * kFrame_s);
}

TEST(TokenBucket, AfterAPauseNothingIsMadeUp) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    for (int i = 0; i < 32; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    now_s += 60;
    const double before_s = now_s;
    for (int i = 32; i < 64; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    EXPECT_NEAR(now_s - before_s, 1, 0.05 + kFrame_s);
}

TEST(TokenBucket, StampsThatJumpAreNotWaitedFor) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    for (const double stamp_s : {0.0, 5e4, 1.0, 1.0 + kFrame_s, -3e5, 9e9}) {
        EXPECT_LT(bucket.wait_s(stamp_s, now_s), kFrame_s);
        now_s += 1;
    }
}

} // namespace
} // namespace shoal::media
