// The hand tracker of the Leap / Ultraleap service, over its WebSocket: no library of theirs is needed.
#pragma once

#include "input/hands/HandRig.h"
#include "input/hands/HandTracker.h"

#include <memory>

namespace shoal::hands {

struct LeapOptions {
    std::string host = "127.0.0.1";
    uint16_t port = 6437;
    bool onHeadset = false; // else on the desk: kHeadMount or kDeskMount
};

// Its thread connects, and connects again whenever the service goes: at once if it was there a moment ago,
// else every kLeapRetry_ms. A service that closes with code 1001 is asked for the protocol one version older;
// one that was gone is asked for the newest again.
constexpr int kNewestLeapVersion = 6;
constexpr int kLeapRetry_ms = 500;
std::unique_ptr<HandTracker> makeLeapTracker(const LeapOptions& options, const HandRig& rig);

} // namespace shoal::hands
