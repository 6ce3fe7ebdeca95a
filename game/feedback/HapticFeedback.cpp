#include "game/feedback/HapticFeedback.h"

#include "game/feedback/EventTable.h"
#include "input/haptics/HapticFrame.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

// Actuation while a touch lasts; the pulses of events are in EventTable.h.
constexpr float kPress = 0.25f, kPressFull_m = 0.02f; // greatest amplitude of pressing, and its depth
constexpr float kPress_Hz = 45;
constexpr float kStroke = 0.5f, kStrokeFull_mps = 0.8f; // greatest amplitude of stroking, and its speed
constexpr float kScale_m = 0.004f; // spacing of a fish's scales: frequency = stroking speed / spacing
constexpr float kStrokeLow_Hz = 40, kStrokeHigh_Hz = 240;
constexpr float kHeld = 0.15f, kStruggle = 0.6f; // amplitude of a held fish at rest; its struggle's part
constexpr float kHeld_Hz = 48, kStruggle_Hz = 30;

// Returns the actuation of a finger while it touches.
haptics::Actuation underFinger(const TouchView& touch, bool held) {
    if (!touch.touches) return {};
    const float press = std::clamp(touch.depth_m / kPressFull_m, 0.0f, 1.0f);
    const float stroke = std::clamp(touch.slide_mps / kStrokeFull_mps, 0.0f, 1.0f);
    haptics::Actuation out = haptics::stronger(
        {kPress * press, kPress_Hz}, {kStroke * stroke * (0.5f + 0.5f * press),
                                      std::clamp(touch.slide_mps / kScale_m, kStrokeLow_Hz, kStrokeHigh_Hz)});
    if (held)
        out = haptics::stronger(
            out, {kHeld + kStruggle * touch.struggle, kHeld_Hz + kStruggle_Hz * touch.struggle});
    return out;
}

} // namespace

void HapticFeedback::startPulse(const Event& event) {
    using Where = HapticPulse::Where;
    const HapticPulse& row = rowOf(event.kind).pulse;
    const float speed = std::clamp(event.closing_mps / kFullSpeed_mps, 0.0f, 1.0f);
    const float share = event.part >= 0 ? speed : 1;
    const Pulse pulse{row.amplitudeLow + (row.amplitude - row.amplitudeLow) * share,
                      row.frequencyLow_Hz + (row.frequency_Hz - row.frequencyLow_Hz) * share, row.decay_s};
    const auto strike = [&](Pulse& own) {
        if (pulse.amplitude >= own.amplitude) own = pulse;
    };
    if (row.where == Where::Body || row.where == Where::HandAndBody) strike(pulses_.back());
    if (row.where == Where::Nowhere || row.where == Where::Body || event.hand < 0) return;
    for (int part = 0; part < haptics::kActuatorsPerHand; ++part)
        if (row.where != Where::Part || part == event.part)
            strike(pulses_[static_cast<size_t>(event.hand * haptics::kActuatorsPerHand + part)]);
}

haptics::HapticFrame HapticFeedback::frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                                           float strength) {
    if (shown.paused || shown.phase == Phase::Results) {
        pulses_ = {};
        return {};
    }
    for (Pulse& pulse : pulses_) pulse.amplitude *= std::exp(-dt_s / pulse.decay_s);
    for (const Event& event : events) startPulse(event);
    haptics::HapticFrame frame;
    for (int i = 0; i < haptics::kActuatorCount; ++i) {
        const Pulse& pulse = pulses_[static_cast<size_t>(i)];
        const HandView& hand = shown.hands[static_cast<size_t>(i / haptics::kActuatorsPerHand)];
        const TouchView& touch = hand.touching[static_cast<size_t>(i % haptics::kActuatorsPerHand)];
        haptics::Actuation out =
            haptics::stronger({pulse.amplitude, pulse.frequency_Hz}, underFinger(touch, hand.holds >= 0));
        out.amplitude = std::clamp(out.amplitude * strength, 0.0f, 1.0f);
        frame.actuators[static_cast<size_t>(i)] = out;
    }
    const Pulse& body = pulses_.back();
    frame.body = {std::clamp(body.amplitude * strength, 0.0f, 1.0f), body.frequency_Hz};
    return frame;
}

} // namespace shoal::game
