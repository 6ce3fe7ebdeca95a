// The devices that track hands while somebody plays, and which of them the game listens to.
#pragma once

#include "game/TickInput.h"
#include "game/app/Options.h"
#include "input/hands/HandChoice.h"
#include "input/hands/leap/LeapHands.h"
#include "input/hands/webcam/WebcamHands.h"

#include <memory>
#include <variant>
#include <vector>

namespace shoal::app {

// One more device: one more alternative, with kName and stream(), and a line in TrackedHands' constructor.
using HandDevice = std::variant<hands::LeapHands, hands::WebcamHands>;

class TrackedHands {
  public:
    // live: time is the clock's; else frames count by their time stamps. Opens what options.source names.
    TrackedHands(const HandOptions& options, const hands::HandRig& rig, bool live);

    // Once a frame of the display.
    void frame(double elapsed_s);

    // Once a tick: input holds the mouse's hands, and then those of the device, if one sees hands.
    void tick(game::TickInput& input, int ticksLeft);

    // To be shown now: which hands these are, or what a device asks of the player. May be empty.
    std::string_view caption() const;

  private:
    struct Seat {
        HandDevice device;
        hands::DeviceHands hands;
        hands::DeviceState state;
        uint64_t stateSeen = 0;
    };
    void listen();
    void announce();

    std::vector<std::unique_ptr<Seat>> seats_; // the best first
    std::vector<const hands::DeviceHands*> order_;
    hands::HandChoice choice_;
    bool asked_; // for one device, not for whichever is there
    static constexpr int kNothing = -2;
    int present_ = hands::HandChoice::kMouse; // the best device that is there
    int announced_ = kNothing;
    std::string said_, asks_;
    double played_s_ = 0, saidAt_s_ = 0;
};

// Fails where options.source names no mouse or device, or a clip that is not there.
Status checkHandSource(const HandOptions& options);

// For `shoal devices`: every source of hands and its state, a line each.
void listHandSources(const HandOptions& options);

} // namespace shoal::app
