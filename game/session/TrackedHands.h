// Hand tracking devices of a session, and the choice of the one whose hands are used. Main thread; the
// devices have threads of their own.
#pragma once

#include "game/rules/TickInput.h"
#include "game/settings/SharedOptions.h"
#include "input/hands/HandRig.h"
#include "input/hands/HandSourceSelector.h"

#include <memory>
#include <vector>

namespace shoal::app {

class TrackedHands {
  public:
    // live: time is the clock's; else frames count by their time stamps. Opens the devices that `source`
    // names.
    TrackedHands(const HandSourceChoice& source, const HandOptions& options, const hands::HandRig& rig,
                 bool live);

    // Once a frame of the display.
    void frame(double elapsed_s);

    // Once a tick: replaces the mouse's hands in `input` by those of the device, if one sees hands.
    void tick(game::TickInput& input, int ticksLeft);

    // To be shown now: which device is used, or what it asks of the player. May be empty.
    std::string_view caption() const;

  private:
    struct Device {
        std::unique_ptr<hands::HandTracker> tracker;
        hands::DeviceHands hands;
        hands::DeviceState state;
        uint64_t stateChanges = 0;
    };
    void updateStates();
    void announce();

    std::vector<std::unique_ptr<Device>> devices_; // the best first
    std::vector<const hands::DeviceHands*> order_;
    hands::HandSourceSelector choice_;
    bool singleDevice_; // for one device, not for whichever is there
    static constexpr int kNothing = -2;
    int present_ = hands::HandSourceSelector::kMouse; // the best device that is there
    int announced_ = kNothing;
    std::string announcement_, instruction_;
    double played_s_ = 0, announcedAt_s_ = 0;
};

// Fails where the source is a clip that is not there.
Status checkHandSource(const HandSourceChoice& source);

} // namespace shoal::app
