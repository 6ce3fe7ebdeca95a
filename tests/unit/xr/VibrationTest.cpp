// One motor for each hand, which is sent no more commands than it needs.
#include "input/haptics/HapticFrame.h"

#include <gtest/gtest.h>

#include <limits>

namespace shoal::haptics {
namespace {

TEST(Vibration, TheStrongestFingerOfEachHandCounts) {
    HapticFrame frame;
    frame.actuators[1] = {0.3f, 140};
    frame.actuators[hands::kPalmPart] = {0.8f, 40};
    frame.actuators[kActuatorsPerHand + 2] = {0.5f, 250};
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 0.8f);
    EXPECT_EQ(vibrationOf(frame, 0).frequency_Hz, 40);
    EXPECT_EQ(vibrationOf(frame, 1).amplitude, 0.5f);
    EXPECT_EQ(vibrationOf(frame, 1).frequency_Hz, 250);
    EXPECT_EQ(vibrationOf({}, 0).amplitude, 0);
}

TEST(Vibration, NoNumberIsNothingAndTooMuchIsAll) {
    HapticFrame frame;
    frame.actuators[0].amplitude = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 0);
    frame.actuators[1].amplitude = 7;
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 1);
}

TEST(Vibration, NewsAtOnceTheSameAgainInTimeSilenceOnce) {
    VibrationTimer timer;
    EXPECT_FALSE(timer.due({0, 0}, 0)); // silent, and was
    EXPECT_TRUE(timer.due({0.5f, 100}, 0.010));
    EXPECT_FALSE(timer.due({0.51f, 100}, 0.020)); // not felt
    EXPECT_TRUE(timer.due({0.7f, 100}, 0.030));
    EXPECT_TRUE(timer.due({0.7f, 200}, 0.040));
    EXPECT_FALSE(timer.due({0.7f, 200}, 0.080));
    EXPECT_TRUE(timer.due({0.7f, 200}, 0.041 + kVibrationAgain_s));
    EXPECT_TRUE(timer.due({0, 0}, 0.095));
    EXPECT_FALSE(timer.due({0, 0}, 9));
}

} // namespace
} // namespace shoal::haptics
