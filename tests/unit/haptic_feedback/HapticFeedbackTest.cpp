#include "game/feedback/Feedback.h"
#include "tests/Test.h"

namespace shoal::game {
namespace {

constexpr float kTick_s = 1.0f / 120;

Event touch(int hand, int finger, float speed_mps) {
    return {.kind = EventKind::Touch, .hand = hand, .part = finger, .closing_mps = speed_mps};
}

float amplitude(const haptics::HapticFrame& frame, int hand, int finger) {
    return frame.actuators[static_cast<size_t>(hand * haptics::kActuatorsPerHand + finger)].amplitude;
}

void expectOthersStill(const haptics::HapticFrame& frame, int hand = -1, int finger = -1) {
    for (int i = 0; i < haptics::kActuatorCount; ++i)
        if (i != hand * haptics::kActuatorsPerHand + finger) {
            EXPECT_EQ(frame.actuators[static_cast<size_t>(i)].amplitude, 0) << i;
        }
}

TEST(HapticFeedback, ATouchIsFeltByTheFingerThatTouchedAndFades) {
    HapticFeedback feel;
    const Event event = touch(1, 2, 10);
    EXPECT_EQ(amplitude(feel.frame({}, {&event, 1}, kTick_s, 1), 1, 2), 1);
    haptics::HapticFrame later;
    for (int i = 0; i < 24; ++i) later = feel.frame({}, {}, kTick_s, 1);
    EXPECT_NEAR(amplitude(later, 1, 2), std::exp(-0.2f / 0.08f), 1e-3f); // 0.2 s at a decay of 0.08 s
    expectOthersStill(later, 1, 2);
}

TEST(HapticFeedback, FasterTouchesAreStrongerAndQuicker) {
    HapticFeedback soft, hard;
    const Event slow = touch(0, 1, 0.1f), fast = touch(0, 1, 1.2f);
    const auto a = soft.frame({}, {&slow, 1}, kTick_s, 1).actuators[1],
               b = hard.frame({}, {&fast, 1}, kTick_s, 1).actuators[1];
    EXPECT_LT(a.amplitude, b.amplitude);
    EXPECT_LT(a.frequency_Hz, b.frequency_Hz);
}

Snapshot touching(int hand, int finger, const TouchView& touch, int holds = -1) {
    Snapshot shown;
    shown.hands[static_cast<size_t>(hand)].holds = holds;
    shown.hands[static_cast<size_t>(hand)].touching[static_cast<size_t>(finger)] = touch;
    return shown;
}

TEST(HapticFeedback, AHeldFishIsFeltWhereItTouchesAndWithItsStruggle) {
    HapticFeedback feel;
    const auto with = [&](float struggle) {
        return feel.frame(touching(0, 2, {.touches = true, .depth_m = 0.01f, .struggle = struggle}, 3), {},
                          kTick_s, 1);
    };
    const auto calm = with(0), wild = with(1);
    EXPECT_GT(amplitude(calm, 0, 2), 0.1f);                         // it is there
    EXPECT_GT(amplitude(wild, 0, 2), amplitude(calm, 0, 2) + 0.4f); // and it wriggles
    expectOthersStill(wild, 0, 2);
}

TEST(HapticFeedback, AStrokeLastsAsLongAsItTouchesAndHumsFasterAsItGoesFaster) {
    HapticFeedback feel;
    const TouchView slow{.touches = true, .depth_m = 0.003f, .slide_mps = 0.2f};
    TouchView quick = slow;
    quick.slide_mps = 0.6f;
    for (int i = 0; i < 240; ++i) {
        const haptics::Actuation felt = feel.frame(touching(1, 1, slow), {}, kTick_s, 1).actuators[7];
        ASSERT_GT(felt.amplitude, 0.02f);
        ASSERT_NEAR(felt.frequency_Hz, 50, 1e-3f); // 0.2 m/s over scales of 4 mm
    }
    EXPECT_NEAR(feel.frame(touching(1, 1, quick), {}, kTick_s, 1).actuators[7].frequency_Hz, 150, 1e-3f);
    EXPECT_EQ(feel.frame({}, {}, kTick_s, 1).actuators[7].amplitude, 0) << "over when it no longer touches";
}

TEST(HapticFeedback, AGentleStrokeIsFarWeakerThanABlow) {
    HapticFeedback feel;
    const TouchView gentle{.touches = true, .depth_m = 0.002f, .press_mps = 0.05f, .slide_mps = 0.15f};
    const float stroke = amplitude(feel.frame(touching(1, 1, gentle), {}, kTick_s, 1), 1, 1);
    const Event blow = touch(1, 1, 2);
    const float struck = amplitude(feel.frame(touching(1, 1, gentle), {&blow, 1}, kTick_s, 1), 1, 1);
    EXPECT_GT(stroke, 0.02f);
    EXPECT_GT(struck, 5 * stroke);
}

TEST(HapticFeedback, PressingDeeperIsFeltStronger) {
    HapticFeedback feel;
    float before = 0;
    for (float depth : {0.002f, 0.006f, 0.012f, 0.02f}) {
        const float felt =
            amplitude(feel.frame(touching(0, 4, {.touches = true, .depth_m = depth}), {}, kTick_s, 1), 0, 4);
        EXPECT_GT(felt, before);
        before = felt;
    }
}

TEST(HapticFeedback, StaysWithinBoundsAndObeysTheSetting) {
    HapticFeedback feel;
    Events storm(50, touch(0, 0, 100));
    for (int i = 0; i < 10; ++i)
        for (const auto& actuator : feel.frame({}, storm, kTick_s, 1).actuators)
            ASSERT_LE(actuator.amplitude, 1);
    EXPECT_NEAR(amplitude(feel.frame({}, storm, kTick_s, 0.5f), 0, 0), 0.5f, 1e-6f);
    EXPECT_EQ(amplitude(feel.frame({}, storm, kTick_s, 0), 0, 0), 0);
}

TEST(HapticFeedback, TheSharkIsFeltByTheBody) {
    for (const Event& event :
         {Event{.kind = EventKind::SharkNear}, Event{.kind = EventKind::SharkBump, .hand = 0},
          Event{.kind = EventKind::SharkSteal, .hand = 0}}) {
        HapticFeedback feel;
        EXPECT_GT(feel.frame({}, {&event, 1}, kTick_s, 1).body.amplitude, 0.2f);
        haptics::HapticFrame later;
        for (int i = 0; i < 600; ++i) later = feel.frame({}, {}, kTick_s, 1); // 5 s, 8 decays at least
        EXPECT_LT(later.body.amplitude, 1e-3f);
        feel.frame({}, {&event, 1}, kTick_s, 1);
        EXPECT_EQ(feel.frame({.paused = true}, {}, kTick_s, 1).body.amplitude, 0);
    }
}

TEST(HapticFeedback, PausedHandsAndFingersThatAreNoneAreStill) {
    HapticFeedback paused, diving;
    const Event right = touch(0, 0, 1), wrong = touch(5, 77, 1);
    expectOthersStill(paused.frame({.paused = true, .hands = {{{.holds = 1}}}}, {&right, 1}, kTick_s, 1));
    expectOthersStill(diving.frame({}, {&wrong, 1}, kTick_s, 1));
}

} // namespace
} // namespace shoal::game
