// Parser of the messages of the Leap / Ultraleap service: JSON, protocol versions 1 to 6, if the service
// sends the joints of fingers; and the hands in its frames as the game wants them.
#pragma once

#include "engine/core/JsonBounds.h"
#include "engine/core/Result.h"
#include "input/hands/CompleteHand.h"
#include "input/hands/HandTracker.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace shoal::hands {

// State of a device, sent when it changes.
struct LeapDevice {
    bool attached = false, streaming = false;
    std::string type;
};

struct LeapFrame {
    std::optional<int64_t> time_us;
    std::vector<PartialHand>
        hands; // device's frame, metres; those with impossible values or without all joints are left out
};

using LeapMessage = std::variant<std::monostate, LeapDevice, LeapFrame>; // monostate: no known message

// Bounds of a message; a frame with two hands and all their bones has 30 kB, 2000 values and depth 5.
constexpr size_t kLeapMessageBytes = 256 * 1024;
constexpr JsonBounds kLeapMessageBounds{.depth = 16, .values = 16 * 1024, .objects = 16 * 1024};

// Fails if the text is no JSON object or exceeds the bounds above, before memory is taken for it.
Result<LeapMessage> readLeapMessage(std::string_view text);

// Assigns a service frame's hands to left and right, completes them and puts them into the viewer's frame.
class LeapTracks {
  public:
    LeapTracks(const HandRig& rig, const Mount& mount) : completer_(rig), placement_(mount) {}

    void connected() { ++connection_; } // a service that starts anew counts its hands anew
    HandFrame frame(const LeapFrame& seen, int64_t time_us);

  private:
    Side sideOf(const PartialHand& hand, const LeapFrame& seen) const;

    HandCompleter completer_;
    HandPlacement placement_;
    int64_t connection_ = 0;
    std::array<int64_t, 2> identity_{-1, -1}; // the service's, in the last frame
};

} // namespace shoal::hands
