// Outlines drawn with a ruler: what is a finger, and what an arm.
#include "input/hands/webcam/HandDetector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::hands {
namespace {

// A palm of 24 pixels' radius with fingers (degrees from straight up, to the right) and perhaps a forearm
// that comes from the picture's edge.
cv::Mat drawn(std::initializer_list<int> fingers, bool arm, cv::Point palm = {160, 90}) {
    cv::Mat mask = cv::Mat::zeros(180, 320, CV_8U);
    cv::circle(mask, palm, 24, 255, cv::FILLED);
    cv::rectangle(mask, palm + cv::Point(-22, -26), palm + cv::Point(22, 0), 255, cv::FILLED);
    if (arm) cv::rectangle(mask, {palm.x - 15, palm.y}, {palm.x + 15, 179}, 255, cv::FILLED);
    for (int degrees : fingers) {
        const double a = degrees * CV_PI / 180;
        cv::line(mask, palm, palm + cv::Point(cvRound(68 * std::sin(a)), cvRound(-68 * std::cos(a))), 255, 9);
    }
    return mask;
}

TEST(FindHands, GesturesWithAndWithoutAForearm) {
    for (bool arm : {false, true}) {
        const auto gesture = [&](std::initializer_list<int> fingers) {
            const auto hands = findHands(drawn(fingers, arm));
            EXPECT_EQ(hands.size(), 1u);
            return hands.empty() ? Gesture::Open : hands[0].gesture;
        };
        EXPECT_EQ(gesture({-33, -12, 9, 30, 75}), Gesture::Open) << arm;
        EXPECT_EQ(gesture({-33, -12, 9}), Gesture::Pinch) << arm;
        EXPECT_EQ(gesture({}), Gesture::Fist) << arm;
        EXPECT_EQ(gesture({-6, -2, 2, 6}), Gesture::Open) << "fingers held together, " << arm;
    }
}

TEST(FindHands, ThePalmIsTheLargestCircleAndTheThumbHasASide) {
    const auto hands = findHands(drawn({-33, -12, 9, 30, 75}, true));
    ASSERT_EQ(hands.size(), 1u);
    EXPECT_NEAR(hands[0].palm.x, 160, 3);
    EXPECT_NEAR(hands[0].palm.y, 90, 6);
    EXPECT_NEAR(hands[0].radius, 24, 3);
    EXPECT_EQ(hands[0].thumb, 1);
    const auto other = findHands(drawn({33, 12, -9, -30, -75}, true));
    ASSERT_EQ(other.size(), 1u);
    EXPECT_EQ(other[0].thumb, -1);
}

TEST(FindHands, ARingIsAPinchAndTheLargestTwoCount) {
    cv::Mat ring = drawn({-20, 0}, false);
    cv::circle(ring, {195, 70}, 16, 255, 7);
    const auto pinch = findHands(ring);
    ASSERT_EQ(pinch.size(), 1u);
    EXPECT_TRUE(pinch[0].ring);
    EXPECT_EQ(pinch[0].gesture, Gesture::Pinch);
    cv::Mat three = drawn({}, false, {60, 90}) | drawn({}, false, {250, 90});
    cv::circle(three, {160, 150}, 14, 255, cv::FILLED);
    EXPECT_EQ(findHands(three).size(), 2u);
    EXPECT_TRUE(findHands(cv::Mat::zeros(180, 320, CV_8U)).empty());
    EXPECT_EQ(findHands(cv::Mat(180, 320, CV_8U, 255)).size(), 1u) << "all of the picture: nothing breaks";
}

} // namespace
} // namespace shoal::hands
