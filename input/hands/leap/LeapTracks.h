// Assignment of the hands in a service's frame to left and right, completed and in the viewer's frame.
#pragma once

#include "input/hands/HandTracker.h"
#include "input/hands/Mount.h"
#include "input/hands/leap/LeapMessage.h"

namespace shoal::hands {

class LeapTracks {
  public:
    LeapTracks(const HandRig& rig, const Mount& mount) : completer_(rig), mount_(mount) {}

    // A service that starts anew counts its hands anew: another connection, another identity.
    void connected() { ++connection_; }
    HandFrame frame(const LeapFrame& seen, int64_t time_us);

  private:
    Side sideOf(const PartialHand& hand, const LeapFrame& seen) const;

    HandCompleter completer_;
    Mount mount_;
    int64_t connection_ = 0;
    std::array<int64_t, 2> identity_{-1, -1}; // as the service gave them, of the last frame
};

} // namespace shoal::hands
