// From what happens, and from what lies under each finger, to what the fingers feel. A blow is a pulse that
// fades; pressing, stroking and the struggle of a held fish last as long as the touch. Pure: time comes in,
// nothing is kept but the pulses.
#pragma once

#include "game/Snapshot.h"
#include "input/haptics/HapticFrame.h"

#include <span>

namespace shoal::game {

class Feel {
  public:
    // events: since the last call; dt_s: time since then. strength: the player's setting, 0 to 1.
    haptics::HapticFrame frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                               float strength);

  private:
    struct Pulse {
        float amplitude = 0; // now
        float frequency_Hz = 0;
        float decay_s = 1; // to 1/e
    };
    static void strike(Pulse& own, const Pulse& pulse);
    void strike(int hand, int finger, const Pulse& pulse);

    std::array<Pulse, haptics::kActuatorCount> pulses_{};
    Pulse body_;
};

} // namespace shoal::game
