// Tests of the constants of HandFilter.h.
#include "engine/core/Random.h"
#include "input/hands/HandFilter.h"
#include "input/hands/HandSourceSelector.h"
#include "tests/Test.h"
#include "tests/TestRig.h"

namespace shoal::hands {
namespace {

using tests::rig;

using namespace tuning;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTick_s = 1.0f / 120;

HandPose handAt(glm::vec3 wrist, float curl = 0) {
    return rig().pose(Side::Right, tests::shape(curl), {wrist, {1, 0, 0, 0}});
}

HandPose strengths(float grip, float pinch) {
    HandPose hand = handAt({0, 0, -0.5f});
    hand.grip = grip;
    hand.pinch = pinch;
    return hand;
}

// The first step of a resting filter goes 1 / (1 + tau / dt) of the way, tau = 1 / (2 pi cut-off).
TEST(Tuning, SmoothingIsThatOfAFirstOrderLowPass) {
    EXPECT_FLOAT_EQ(smoothing(1 / (2 * kPi), 1), 0.5f);
    EXPECT_FLOAT_EQ(smoothing(4, 0), 0);
    EXPECT_NEAR(smoothing(1e6f, 0.01f), 1, 1e-4f);
}

// A ramp of speed v is followed at the cut-off f = min + slope v with the lag 1 / (2 pi f) (the continuous
// filter's; the discrete one's is shorter by at most a sample).
TEST(Tuning, TheLagOfAMovingHandIsWhatSlopeAndCutoffSay) {
    for (float speed : {0.1f, 0.5f, 2.0f}) {
        OneEuroPoint filter(kPosition);
        constexpr float kDt = 1.0f / 110;
        filter.reset(glm::vec3(0));
        float x = 0;
        for (int i = 0; i < 220; ++i) filter.step({x += speed * kDt, 0, 0}, kDt);
        const float lag_s = (x - filter.value().x) / speed;
        const float expected = 1 / (2 * kPi * (kPosition.minCutoff_Hz + kPosition.slope * speed));
        EXPECT_NEAR(lag_s, expected, kDt) << speed;
        EXPECT_LE(lag_s, expected + 1e-4f);
    }
}

// White noise of variance s^2 through a first-order low-pass with share a has variance s^2 a / (2 - a).
TEST(Tuning, AStillHandsNoiseShrinksAsTheCutoffSays) {
    const OneEuroTuning still{kPosition.minCutoff_Hz, 0, kPosition.speedCutoff_Hz};
    OneEuroPoint filter(still);
    filter.reset(glm::vec3(0));
    Random random(1);
    constexpr int kCount = 200000;
    double in = 0, out = 0;
    for (int i = 0; i < kCount; ++i) {
        const float x = random.between(-0.5f, 0.5f);
        const float y = filter.step({x, 0, 0}, 0.01f).x;
        in += static_cast<double>(x) * static_cast<double>(x);
        out += static_cast<double>(y) * static_cast<double>(y);
    }
    const double a = static_cast<double>(smoothing(kPosition.minCutoff_Hz, 0.01f));
    EXPECT_NEAR(out / in, a / (2 - a), 0.02 * a / (2 - a)); // 200000 samples: 2 % is five deviations
}

TEST(Tuning, OrientationsAreFilteredAlongTheShorterArc) {
    OneEuroTurn filter(kOrientation);
    const glm::quat a(1, 0, 0, 0), b = glm::angleAxis(0.4f, glm::vec3(0, 0, 1));
    filter.reset(a);
    float before = 0;
    for (int i = 0; i < 100; ++i) {
        filter.step(i % 2 ? b : -b, 0.01f); // both mean the same turn
        const float angle = 2 * std::atan2(filter.value().z, filter.value().w);
        EXPECT_GE(angle, before - 1e-5f);
        EXPECT_LE(angle, 0.4f + 1e-4f);
        EXPECT_NEAR(glm::length(filter.value()), 1, 1e-5f);
        before = angle;
    }
    EXPECT_NEAR(before, 0.4f, 1e-3f);
}

TEST(Tuning, FingersDoNotTrailBehindAMovingHandAndBonesKeepTheirLength) {
    HandFilter filter;
    for (int i = 0; i < 60; ++i) {
        const HandPose seen = handAt({0.02f * static_cast<float>(i), 0, -0.5f},
                                     0.5f + 0.3f * std::sin(0.3f * static_cast<float>(i)));
        filter.step(seen, 1, i * 9000);
        for (int j = 2; j < kJointCount; ++j) {
            const int parent = kJointParent[j];
            EXPECT_NEAR(
                glm::distance(filter.pose().joints[j].position, filter.pose().joints[parent].position),
                glm::distance(seen.joints[j].position, seen.joints[parent].position), 2e-6f);
        }
    }
    HandFilter still;
    for (int i = 0; i < 60; ++i) still.step(handAt({0.02f * static_cast<float>(i), 0, -0.5f}), 1, i * 9000);
    const HandPose& moved = still.pose();
    const HandPose rest = handAt(glm::vec3(0));
    for (int j = 0; j < kJointCount; ++j)
        EXPECT_NEAR(glm::distance(moved.joints[j].position - moved.joints[0].position,
                                  rest.joints[j].position - rest.joints[0].position),
                    0, 1e-5f);
}

TEST(Tuning, AStretchEndsAtAGapAJumpAnotherIdentityOrALoss) {
    const auto stretchesAfter = [](const HandPose& second, int64_t identity, float dt_s) {
        HandFilter filter;
        filter.step(handAt({0, 0, -0.5f}), 1, 0);
        filter.step(second, identity, static_cast<int64_t>(dt_s * 1e6f));
        return filter.stretch();
    };
    const HandPose there = handAt({0, 0, -0.5f});
    const float fast = kJump_m + kFastest_mps * 0.01f;
    EXPECT_EQ(stretchesAfter(there, 1, 0.01f), 1);
    EXPECT_EQ(stretchesAfter(there, 1, 0.99f * kHandLost_s), 1);
    EXPECT_EQ(stretchesAfter(there, 1, 1.01f * kHandLost_s), 2);
    EXPECT_EQ(stretchesAfter(there, 1, -1), 2) << "a clock that starts anew";
    EXPECT_EQ(stretchesAfter(there, 2, 0.01f), 2);
    EXPECT_EQ(stretchesAfter(handAt({0.98f * fast, 0, -0.5f}), 1, 0.01f), 1) << "a hand may be that fast";
    EXPECT_EQ(stretchesAfter(handAt({1.02f * fast, 0, -0.5f}), 1, 0.01f), 2);
    EXPECT_GE(kFastest_mps, 20) << "hands of 20 m/s are hands";
    HandFilter lost;
    lost.step(there, 1, 0);
    lost.step({}, 0, 10000);
    EXPECT_FALSE(lost.seen());
    lost.step(there, 1, 20000);
    EXPECT_EQ(lost.stretch(), 2);
}

TEST(Tuning, AbsurdJointsAreALoss) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (float bad : {nan, 1e30f, -std::numeric_limits<float>::infinity()}) {
        HandFilter filter;
        filter.step(handAt({0, 0, -0.5f}), 1, 0);
        HandPose torn = handAt({0, 0, -0.5f});
        torn.joints[8].position.y = bad;
        filter.step(torn, 1, 10000);
        EXPECT_FALSE(filter.seen());
        filter.step(handAt({0, 0, -0.5f}), 1, 20000);
        EXPECT_TRUE(filter.seen());
        EXPECT_TRUE(plausible(filter.pose()));
    }
}

TEST(Tuning, ALossIsBridgedForSoLongAndTheGripKept) {
    PoseBlend hand;
    HandPose fist = handAt({0, 0, -0.5f}, 1);
    for (int i = 0; i < 60; ++i) hand.step(fist, 1, 0, kTick_s);
    ASSERT_TRUE(hand.pose().solid);
    const HandPose before = hand.pose();
    float lost_s = 0;
    while ((lost_s += kTick_s) <= kHandLost_s) {
        hand.step(fist, 1, lost_s, kTick_s);
        ASSERT_TRUE(hand.pose().tracked) << lost_s;
        EXPECT_TRUE(hand.pose().solid);
        EXPECT_EQ(hand.pose().grip, before.grip);
        EXPECT_EQ(hand.pose().joints[10].position, before.joints[10].position);
        EXPECT_LT(hand.pose().confidence, before.confidence);
    }
    hand.step(fist, 1, lost_s, kTick_s);
    EXPECT_FALSE(hand.pose().tracked);
}

TEST(Tuning, AHandThatComesBackElsewhereGlidesThereAndIsNotSolid) {
    constexpr float kTears_mps = 6; // what tears a fish out of a hand; see the game's rules
    for (float distance : {0.15f, 0.6f, 1.5f}) {
        PoseBlend hand;
        const HandPose a = handAt({-0.7f, 0, -0.5f}, 1), b = handAt({-0.7f + distance, 0, -0.5f}, 1);
        for (int i = 0; i < 60; ++i) hand.step(a, 1, 0, kTick_s);
        for (int i = 0; i < 12; ++i) hand.step(a, 1, 0.1f, kTick_s); // lost for a moment
        float glided_s = 0;
        glm::vec3 before = hand.pose().joints[0].position;
        do {
            hand.step(b, 2, 0, kTick_s);
            const glm::vec3 now = hand.pose().joints[0].position;
            EXPECT_LT(glm::distance(now, before) / kTick_s, kTears_mps);
            EXPECT_TRUE(hand.pose().tracked);
            EXPECT_TRUE(plausible(hand.pose()));
            EXPECT_GT(hand.pose().grip, kGripCloses) << "what it holds stays held";
            before = now;
            glided_s += kTick_s;
        } while (!hand.pose().solid);
        EXPECT_EQ(before, b.joints[0].position);
        EXPECT_NEAR(glided_s, std::clamp(distance / kGlide_mps, kGlideMin_s, kGlideMax_s), 2 * kTick_s);
    }
}

TEST(Tuning, AFlickerInPlaceStaysSolid) {
    PoseBlend hand;
    const HandPose a = handAt({0, 0, -0.5f}), near = handAt({0.9f * kNear_m, 0, -0.5f}),
                   far = handAt({1.1f * kNear_m, 0, -0.5f});
    for (int i = 0; i < 60; ++i) hand.step(a, 1, 0, kTick_s);
    PoseBlend other = hand;
    EXPECT_TRUE(hand.step(near, 2, 0, kTick_s).solid);
    EXPECT_FALSE(other.step(far, 2, 0, kTick_s).solid);
}

TEST(Tuning, AGlideInterruptedByAnotherGoesOnFromWhereItIs) {
    PoseBlend hand;
    const HandPose a = handAt({-0.4f, 0, -0.5f}), b = handAt({0.4f, 0, -0.5f}), c = handAt({0, 0.4f, -0.5f});
    for (int i = 0; i < 60; ++i) hand.step(a, 1, 0, kTick_s);
    for (int i = 0; i < 20; ++i) hand.step(b, 2, 0, kTick_s);
    const glm::vec3 there = hand.pose().joints[0].position;
    EXPECT_NEAR(glm::distance(hand.step(c, 3, 0, kTick_s).joints[0].position, there), 0, 0.02f);
    EXPECT_FALSE(hand.pose().solid);
}

TEST(Tuning, AHandOutOfNothingIsNotSolidAtFirst) {
    PoseBlend hand;
    EXPECT_FALSE(hand.step({}, 0, 0, kTick_s).tracked);
    float shown_s = 0;
    const HandPose there = handAt({0, 0, -0.5f});
    while (!hand.step(there, 1, 0, kTick_s).solid) {
        EXPECT_TRUE(hand.pose().tracked);
        EXPECT_EQ(hand.pose().joints[0].position, there.joints[0].position);
        ASSERT_LT(shown_s += kTick_s, 1);
    }
    EXPECT_NEAR(shown_s, kAppear_s, 2 * kTick_s);
}

Gesture after(std::initializer_list<std::pair<float, float>> gripsAndPinches, HandPose* last = nullptr) {
    GestureLatch latch;
    Gesture gesture = Gesture::Open;
    for (const auto& [grip, pinch] : gripsAndPinches) {
        HandPose hand = strengths(grip, pinch);
        gesture = latch.step(hand.grip, hand.pinch, 1); // long enough to be there
        EXPECT_FALSE(hand.grip > kOpenMax && hand.grip < kClosedMin);
        EXPECT_FALSE(hand.pinch > kOpenMax && hand.pinch < kClosedMin);
        EXPECT_FALSE(hand.grip >= kClosedMin && hand.pinch >= kClosedMin) << "both at once";
        if (last) *last = hand;
    }
    return gesture;
}

TEST(Tuning, GripAndPinchHaveHysteresis) {
    const float grip = (kGripOpens + kGripCloses) / 2, pinch = (kPinchOpens + kPinchCloses) / 2;
    EXPECT_EQ(after({{grip, 0}}), Gesture::Open);
    EXPECT_EQ(after({{kGripCloses + 0.01f, 0}, {grip, 0}, {kGripOpens + 0.01f, 0}}), Gesture::Fist);
    EXPECT_EQ(after({{1, 0}, {kGripOpens - 0.01f, 0}, {grip, 0}}), Gesture::Open);
    EXPECT_LE(kOpenMax, kGripOpens);
    EXPECT_GE(kClosedMin, kGripCloses);
    EXPECT_EQ(after({{0, pinch}}), Gesture::Open);
    EXPECT_EQ(after({{0, kPinchCloses + 0.01f}, {0, pinch}}), Gesture::Pinch);
    EXPECT_EQ(after({{0, 1}, {0, kPinchOpens - 0.01f}, {0, pinch}}), Gesture::Open);
}

TEST(Tuning, APinchIsNotAlsoAFist) {
    HandPose last;
    EXPECT_EQ(after({{0.1f, 1}, {kPinchToFist - 0.01f, 1}}, &last), Gesture::Pinch);
    EXPECT_LE(last.grip, kOpenMax);
    EXPECT_EQ(after({{0.1f, 1}, {kPinchToFist + 0.01f, 1}}, &last), Gesture::Fist);
    EXPECT_LE(last.pinch, kOpenMax) << "and a fist, whose thumb lies on the index, is no pinch";
    EXPECT_EQ(after({{1, 1}}), Gesture::Fist);
}

TEST(Tuning, OneWrongFrameInAHundredDoesNotOpenTheHand) {
    // kStrengthTau_s: after one frame of 1/110 s with no grip a full grip is still exp(-dt / tau) = 0.40.
    GestureLatch latch;
    for (int i = 0; i < 100; ++i) {
        HandPose hand = strengths(i == 50 ? 0.0f : 1.0f, 0);
        EXPECT_EQ(latch.step(hand.grip, hand.pinch, 1.0f / 110), Gesture::Fist) << i;
    }
}

} // namespace
} // namespace shoal::hands
