// Actuation of every haptic actuator: a fading pulse for each event; and pressing, stroking and the struggle
// of a held fish while a finger touches it. Time is an argument; the pulses are the only state.
#pragma once

#include "game/rules/Snapshot.h"
#include "input/haptics/HapticFrame.h"

#include <span>

namespace shoal::game {

class HapticFeedback {
  public:
    // Returns the actuation of a frame. events: since the last call; dt_s: time since then; strength: the
    // player's setting, 0 to 1.
    haptics::HapticFrame frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                               float strength);

  private:
    struct Pulse {
        float amplitude = 0; // present amplitude
        float frequency_Hz = 0;
        float decay_s = 1; // time constant: falls to 1/e
    };
    void startPulse(const Event&);

    std::array<Pulse, haptics::kActuatorCount + 1> pulses_{}; // the last is the body's
};

} // namespace shoal::game
