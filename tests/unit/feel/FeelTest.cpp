#include "game/Feel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::game {
namespace {

constexpr float kTick_s = 1.0f / 120;

Event touch(int hand, int finger, float speed_mps) {
    return {.kind = Event::Kind::Touch, .hand = hand, .finger = finger, .strength = speed_mps};
}

float amplitude(const haptics::HapticFrame& frame, int hand, int finger) {
    return frame.actuators[static_cast<size_t>(hand * haptics::kActuatorsPerHand + finger)].amplitude;
}

TEST(Feel, NothingHappensNothingIsFelt) {
    Feel feel;
    const haptics::HapticFrame frame = feel.frame({}, {}, kTick_s, 1);
    for (const auto& actuator : frame.actuators) EXPECT_EQ(actuator.amplitude, 0);
}

TEST(Feel, ATouchIsFeltByTheFingerThatTouchedAndFades) {
    Feel feel;
    const Event event = touch(1, 2, 10);
    const float first = amplitude(feel.frame({}, {&event, 1}, kTick_s, 1), 1, 2);
    EXPECT_EQ(first, 1);
    haptics::HapticFrame later;
    for (int i = 0; i < 24; ++i) later = feel.frame({}, {}, kTick_s, 1);
    EXPECT_NEAR(amplitude(later, 1, 2), std::exp(-0.2f / 0.08f), 1e-3f); // 0.2 s at a decay of 0.08 s
    for (int hand = 0; hand < 2; ++hand)
        for (int finger = 0; finger < haptics::kActuatorsPerHand; ++finger)
            if (hand != 1 || finger != 2) {
                EXPECT_EQ(amplitude(later, hand, finger), 0);
            }
}

TEST(Feel, FasterTouchesAreStrongerAndQuicker) {
    Feel soft, hard;
    const Event slow = touch(0, 1, 0.1f), fast = touch(0, 1, 1.2f);
    const auto a = soft.frame({}, {&slow, 1}, kTick_s, 1).actuators[1],
               b = hard.frame({}, {&fast, 1}, kTick_s, 1).actuators[1];
    EXPECT_LT(a.amplitude, b.amplitude);
    EXPECT_LT(a.frequency_Hz, b.frequency_Hz);
}

TEST(Feel, AHeldFishPurrsInThatHandAlone) {
    Feel feel;
    Snapshot shown;
    shown.hands[0].holds = 3;
    float low = 1, high = 0;
    for (int i = 0; i < 120; ++i) {
        const auto frame = feel.frame(shown, {}, kTick_s, 1);
        low = std::min(low, amplitude(frame, 0, 4));
        high = std::max(high, amplitude(frame, 0, 4));
        ASSERT_EQ(amplitude(frame, 1, 4), 0);
    }
    EXPECT_GT(low, 0.1f);        // steady
    EXPECT_GT(high - low, 0.2f); // and wriggling
}

TEST(Feel, StaysWithinBoundsAndObeysTheSetting) {
    Feel feel;
    std::vector<Event> storm(50, touch(0, 0, 100));
    for (int i = 0; i < 10; ++i)
        for (const auto& actuator : feel.frame({}, storm, kTick_s, 1).actuators)
            ASSERT_LE(actuator.amplitude, 1);
    EXPECT_NEAR(amplitude(feel.frame({}, storm, kTick_s, 0.5f), 0, 0), 0.5f, 1e-6f);
    EXPECT_EQ(amplitude(feel.frame({}, storm, kTick_s, 0), 0, 0), 0);
}

TEST(Feel, TheSharkIsFeltByTheBody) {
    for (const Event::Kind kind : {Event::Kind::SharkNear, Event::Kind::SharkBump, Event::Kind::SharkSteal}) {
        Feel feel;
        const Event event{.kind = kind, .hand = 0};
        EXPECT_GT(feel.frame({}, {&event, 1}, kTick_s, 1).body.amplitude, 0.2f);
        haptics::HapticFrame later;
        for (int i = 0; i < 600; ++i) later = feel.frame({}, {}, kTick_s, 1); // 5 s, 8 decays at least
        EXPECT_LT(later.body.amplitude, 1e-3f);
        feel.frame({}, {&event, 1}, kTick_s, 1);
        EXPECT_EQ(feel.frame({.paused = true}, {}, kTick_s, 1).body.amplitude, 0);
    }
}

TEST(Feel, PausedHandsAreStill) {
    Feel feel;
    const Event event = touch(0, 0, 1);
    Snapshot shown;
    shown.paused = true;
    shown.hands[0].holds = 1;
    for (const auto& actuator : feel.frame(shown, {&event, 1}, kTick_s, 1).actuators)
        EXPECT_EQ(actuator.amplitude, 0);
}

TEST(Feel, WrongFingersAreIgnored) {
    Feel feel;
    const Event event = touch(5, 77, 1);
    for (const auto& actuator : feel.frame({}, {&event, 1}, kTick_s, 1).actuators)
        EXPECT_EQ(actuator.amplitude, 0);
}

} // namespace
} // namespace shoal::game
