#include "game/Feel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::game {

namespace {

// Every constant of the feel, in one place.
constexpr float kTouchLeast = 0.25f;   // amplitude of the gentlest touch
constexpr float kTouchFull_mps = 1.5f; // closing speed at which a touch is felt fully
constexpr float kTouchDecay_s = 0.08f;
constexpr float kTouchLow_Hz = 140, kTouchHigh_Hz = 260; // slow and fast touches
constexpr float kPurr = 0.35f,
                kPurrSwing = 0.2f; // amplitude of a held fish, and how far its wriggle swings it
constexpr float kPurr_Hz = 48, kWriggle_Hz = 6;
constexpr float kCatch = 0.8f, kCatchDecay_s = 0.18f, kCatch_Hz = 180;
constexpr float kThump = 1, kThumpDecay_s = 0.25f, kThump_Hz = 40;
constexpr float kNear = 0.3f, kNearDecay_s = 0.6f, kNear_Hz = 30;

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
    purr_s_ = std::fmod(purr_s_ + dt_s, 1.0f); // a whole number of wriggles
    const float wriggle = std::sin(2 * std::numbers::pi_v<float> * kWriggle_Hz * purr_s_);
    haptics::HapticFrame frame;
    for (int i = 0; i < haptics::kActuatorCount; ++i) {
        const Pulse& pulse = pulses_[static_cast<size_t>(i)];
        haptics::Actuation out{pulse.amplitude, pulse.frequency_Hz};
        const bool holds = shown.hands[static_cast<size_t>(i / haptics::kActuatorsPerHand)].holds >= 0;
        const float purr = holds ? kPurr + kPurrSwing * wriggle : 0;
        if (purr > out.amplitude) out = {purr, kPurr_Hz};
        out.amplitude = std::clamp(out.amplitude * strength, 0.0f, 1.0f);
        frame.actuators[static_cast<size_t>(i)] = out;
    }
    frame.body = {std::clamp(body_.amplitude * strength, 0.0f, 1.0f), body_.frequency_Hz};
    return frame;
}

} // namespace shoal::game
