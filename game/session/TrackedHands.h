// The hand tracking device of a session; where it sees no hands, the mouse has them. Main thread; the device
// has threads of its own.
#pragma once

#include "game/rules/TickInput.h"
#include "game/settings/SharedOptions.h"
#include "input/hands/HandRig.h"
#include "input/hands/HandSourceSelector.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace shoal::app {

class TrackedHands {
  public:
    // live: time is the clock's; else frames count by their time stamps. source: Leap, Webcam, or Auto, which
    // never means a camera: that looks at people and is opened only when it is asked for.
    TrackedHands(const HandSourceChoice& source, const HandOptions& options, const hands::HandRig& rig,
                 bool live);

    // Once a frame of the display.
    void frame(double elapsed_s);

    // Once a tick: replaces the mouse's hands in `input` by those of the device, if one sees hands.
    void tick(game::TickInput& input, int ticksLeft);

    // To be shown now: which device is used, or what it asks of the player. May be empty.
    std::string_view caption() const;

  private:
    void announce();

    bool asked_; // for this device, not for whichever is there
    std::unique_ptr<hands::HandTracker> tracker_;
    hands::DeviceHands hands_;
    hands::DeviceState state_;
    hands::HandSourceSelector choice_; // between its hands and the mouse's
    std::optional<bool> announced_;    // that it is there, or that it is not
    std::string announcement_;
    double played_s_ = 0, announcedAt_s_ = 0;
};

// Fails where the source is a clip that is not there.
Status checkHandSource(const HandSourceChoice& source);

} // namespace shoal::app
