// Hands from the Leap / Ultraleap service, over its WebSocket: no library of theirs is needed.
#pragma once

#include "input/hands/HandFrame.h"
#include "input/hands/HandRig.h"
#include "input/hands/Mount.h"

#include <memory>

namespace shoal::hands {

struct LeapOptions {
    std::string host = "127.0.0.1";
    uint16_t port = 6437;
    bool onHeadset = false; // else on the desk: kHeadMount or kDeskMount
};

class LeapHands {
  public:
    static constexpr int kNewestVersion = 6;
    static constexpr int kRetry_ms = 500;

    // Starts a thread that connects, and connects again whenever the service goes, until this dies: at once
    // if it was there a moment ago, else every kRetry_ms. A service that closes with code 1001 is asked for
    // the protocol one version older; one that was gone is asked for the newest again.
    LeapHands(const LeapOptions& options, const HandRig& rig);
    LeapHands(LeapHands&&) noexcept;
    LeapHands& operator=(LeapHands&&) noexcept;
    ~LeapHands();

    static constexpr const char* kName = "Leap Motion";
    HandStream& stream();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shoal::hands
