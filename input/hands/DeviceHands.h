// The hands of one tracker, filtered, on the game's clock.
#pragma once

#include "input/hands/HandFilter.h"

#include <optional>

namespace shoal::hands {

// When a device's frames count. Live: as they come. Stamps: when the game's time has come to their time
// stamps, for which the game waits: then the same recording gives the same game, however fast either runs.
enum class DeviceTime { Live, Stamps };

class DeviceHands {
  public:
    explicit DeviceHands(DeviceTime time) : time_(time) {}

    // Takes what the stream holds for the next elapsed_s of the game.
    void advance(HandStream& stream, double elapsed_s);

    const HandFilter& hand(int side) const { return filters_[static_cast<size_t>(side)]; }
    float notSeen_s(int side) const { return notSeen_s_[static_cast<size_t>(side)]; } // since it last was
    bool seesHands(float within_s) const { return notSeen_s_[0] <= within_s || notSeen_s_[1] <= within_s; }

  private:
    bool due(HandStream& stream, HandFrame& frame);

    DeviceTime time_;
    std::array<HandFilter, 2> filters_;
    std::array<float, 2> notSeen_s_{1e6f, 1e6f};
    // For Stamps.
    int64_t game_us_ = 0;
    int64_t gameFromDevice_us_ = 0;
    int64_t last_us_ = 0;
    std::optional<HandFrame> ahead_; // taken from the stream, its time still to come
    bool begun_ = false;
    bool silent_ = false; // nothing came while it was waited for: not waited for again until something does
};

} // namespace shoal::hands
