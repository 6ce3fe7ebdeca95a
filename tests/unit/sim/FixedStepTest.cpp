#include "engine/sim/FixedStep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shoal::sim {
namespace {

TEST(FixedStep, AnyDisplayRateGivesTheSameTicks) {
    for (int fps : {24, 30, 50, 60, 72, 90, 120, 144, 240, 1000}) {
        FixedStep step;
        int ticks = 0;
        for (int frame = 0; frame < 100 * fps; ++frame) ticks += step.advance(1.0 / fps);
        // Frame times are whole nanoseconds: 100 s of them are short or long by at most half of one per
        // frame.
        EXPECT_NEAR(ticks, 12000, 1) << fps;
    }
}

TEST(FixedStep, ALongFrameIsCaughtUpAndAVeryLongOneForgotten) {
    FixedStep step;
    EXPECT_EQ(step.advance(0.3), 36);
    EXPECT_EQ(step.advance(10), 60);
    EXPECT_EQ(step.advance(-1), 0);
    EXPECT_EQ(step.advance(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(step.advance(std::numeric_limits<double>::infinity()), 0);
}

TEST(FixedStep, AlphaIsTheRemainder) {
    FixedStep step;
    EXPECT_EQ(step.advance(1.5 / kTickRate_Hz), 1);
    EXPECT_NEAR(step.alpha(), 0.5f, 1e-6f); // half a nanosecond of 8.3 ms
    EXPECT_EQ(step.advance(0.4999 / kTickRate_Hz), 0);
    EXPECT_LT(step.alpha(), 1.0f);
    EXPECT_GT(step.alpha(), 0.99f);
}

} // namespace
} // namespace shoal::sim
