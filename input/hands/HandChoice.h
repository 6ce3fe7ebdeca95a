// Whose hands the game gets: those of the best device that sees any, else the mouse's.
#pragma once

#include "input/hands/Continuity.h"
#include "input/hands/DeviceHands.h"

#include <span>

namespace shoal::hands {

class HandChoice {
  public:
    static constexpr int kMouse = -1;

    // Once a frame of the display, after the devices have advanced; the best comes first.
    void frame(std::span<const DeviceHands* const> devices);

    // Once a tick: takes the mouse's hands and gives those chosen. ticksLeft: of this frame, this one among
    // them; what came since the last frame is spread over them, so that a hand moves evenly.
    void tick(std::array<HandPose, 2>& hands, int ticksLeft, float dt_s);

    int chosen() const { return chosen_; } // index into the devices, or kMouse

  private:
    struct Hand {
        HandPose newest; // of the device chosen
        int stretch = 0;
        float notSeen_s = 0;
        HandPose target; // on the way to the newest
        int targetStretch = 0;
        Continuity continuity;
    };
    int chosen_ = kMouse;
    bool everChosen_ = false; // a device: until then the mouse's hands pass as they are
    int changes_ = 0;
    std::array<Hand, 2> hands_;
};

} // namespace shoal::hands
