#include "game/Feel.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

// Every constant of the feel, in one place.
constexpr float kTouchLeast = 0.15f;   // amplitude of the gentlest touch
constexpr float kTouchFull_mps = 1.5f; // closing speed at which a touch is felt fully
constexpr float kTouchDecay_s = 0.08f;
constexpr float kTouchLow_Hz = 140, kTouchHigh_Hz = 260; // slow and fast touches
constexpr float kPress = 0.25f, kPressFull_m = 0.02f;    // steady pressing, and the depth at which it is full
constexpr float kPress_Hz = 45;
constexpr float kStroke = 0.5f, kStrokeFull_mps = 0.8f; // stroking along, and the speed at which it is full
constexpr float kScale_m = 0.004f;                      // from scale to scale: so many pass a second
constexpr float kStrokeLow_Hz = 40, kStrokeHigh_Hz = 240;
constexpr float kHeld = 0.15f, kStruggle = 0.6f; // a fish in the hand at rest, and its struggle on top
constexpr float kHeld_Hz = 48, kStruggle_Hz = 30;
constexpr float kCatch = 0.8f, kCatchDecay_s = 0.18f, kCatch_Hz = 180;
constexpr float kThump = 1, kThumpDecay_s = 0.25f, kThump_Hz = 40;
constexpr float kNear = 0.3f, kNearDecay_s = 0.6f, kNear_Hz = 30;

haptics::Actuation stronger(const haptics::Actuation& a, const haptics::Actuation& b) {
    return b.amplitude > a.amplitude ? b : a;
}

// For as long as it touches: what lies under a finger.
haptics::Actuation underFinger(const TouchView& touch, bool held) {
    if (!touch.touches) return {};
    const float press = std::clamp(touch.depth_m / kPressFull_m, 0.0f, 1.0f);
    const float stroke = std::clamp(touch.slide_mps / kStrokeFull_mps, 0.0f, 1.0f);
    haptics::Actuation out = stronger(
        {kPress * press, kPress_Hz}, {kStroke * stroke * (0.5f + 0.5f * press),
                                      std::clamp(touch.slide_mps / kScale_m, kStrokeLow_Hz, kStrokeHigh_Hz)});
    if (held)
        out = stronger(out, {kHeld + kStruggle * touch.struggle, kHeld_Hz + kStruggle_Hz * touch.struggle});
    return out;
}

} // namespace

void Feel::strike(Pulse& own, const Pulse& pulse) {
    if (pulse.amplitude >= own.amplitude) own = pulse;
}

void Feel::strike(int hand, int finger, const Pulse& pulse) {
    if (hand < 0 || hand > 1 || finger < 0 || finger >= haptics::kActuatorsPerHand) return;
    strike(pulses_[static_cast<size_t>(hand * haptics::kActuatorsPerHand + finger)], pulse);
}

haptics::HapticFrame Feel::frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                                 float strength) {
    if (shown.paused || shown.phase == Phase::Results) {
        pulses_ = {};
        body_ = {};
        return {};
    }
    for (Pulse& pulse : pulses_) pulse.amplitude *= std::exp(-dt_s / pulse.decay_s);
    body_.amplitude *= std::exp(-dt_s / body_.decay_s);
    for (const Event& event : events) {
        const auto wholeHand = [&](const Pulse& pulse) {
            for (int finger = 0; finger < haptics::kActuatorsPerHand; ++finger)
                strike(event.hand, finger, pulse);
        };
        const float speed = std::clamp(event.strength / kTouchFull_mps, 0.0f, 1.0f);
        switch (event.kind) {
        case Event::Kind::Touch:
            strike(event.hand, event.finger,
                   {kTouchLeast + (1 - kTouchLeast) * speed,
                    kTouchLow_Hz + (kTouchHigh_Hz - kTouchLow_Hz) * speed, kTouchDecay_s});
            break;
        case Event::Kind::Catch:
            wholeHand({kCatch, kCatch_Hz, kCatchDecay_s});
            break;
        case Event::Kind::SharkBump:
        case Event::Kind::SharkSteal:
            wholeHand({kThump, kThump_Hz, kThumpDecay_s});
            strike(body_, {kThump, kThump_Hz, kThumpDecay_s});
            break;
        case Event::Kind::SharkNear:
            strike(body_, {kNear, kNear_Hz, kNearDecay_s});
            break;
        default:
            break;
        }
    }
    haptics::HapticFrame frame;
    for (int i = 0; i < haptics::kActuatorCount; ++i) {
        const Pulse& pulse = pulses_[static_cast<size_t>(i)];
        const HandView& hand = shown.hands[static_cast<size_t>(i / haptics::kActuatorsPerHand)];
        const TouchView& touch = hand.touching[static_cast<size_t>(i % haptics::kActuatorsPerHand)];
        haptics::Actuation out =
            stronger({pulse.amplitude, pulse.frequency_Hz}, underFinger(touch, hand.holds >= 0));
        out.amplitude = std::clamp(out.amplitude * strength, 0.0f, 1.0f);
        frame.actuators[static_cast<size_t>(i)] = out;
    }
    frame.body = {std::clamp(body_.amplitude * strength, 0.0f, 1.0f), body_.frequency_Hz};
    return frame;
}

} // namespace shoal::game
