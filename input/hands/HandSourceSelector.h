// The hands of a tracker, filtered, on the game's clock, and the selection of the hands that the game gets:
// those of the tracker while it sees any, else the mouse's.
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

    // Takes what the stream holds for the next elapsed_s of the game, which end now.
    void advance(HandStream& stream, double elapsed_s, Clock::time_point now);

    const HandFilter& hand(int side) const { return filters_[static_cast<size_t>(side)]; }
    float notSeen_s(int side) const { return notSeen_s_[static_cast<size_t>(side)]; } // since it last was
    // Since the moment at which it was where hand() has it: notSeen_s() and what a picture takes to get here.
    float age_s(int side) const { return notSeen_s(side) + lateness_s_[static_cast<size_t>(side)]; }
    // As in HandFrame, of the last time that the hand was seen.
    glm::vec3 towardsElbow(int side) const { return towardsElbow_[static_cast<size_t>(side)]; }
    float asRig_m(int side) const { return asRig_m_[static_cast<size_t>(side)]; } // the same
    bool seesHands(float within_s) const { return notSeen_s_[0] <= within_s || notSeen_s_[1] <= within_s; }

  private:
    bool due(HandStream& stream, HandFrame& frame);

    DeviceTime time_;
    std::array<HandFilter, 2> filters_;
    std::array<float, 2> notSeen_s_{1e6f, 1e6f};
    std::array<float, 2> lateness_s_{};
    std::array<glm::vec3, 2> towardsElbow_{};
    std::array<float, 2> asRig_m_{};
    // For Stamps.
    int64_t game_us_ = 0;
    int64_t gameFromDevice_us_ = 0;
    int64_t last_us_ = 0;
    std::optional<HandFrame> ahead_; // taken from the stream, its time still to come
    bool begun_ = false;
    bool silent_ = false; // nothing came while it was waited for: not waited for again until something does
};

// The pose that the simulation gets of one hand, tick by tick: short losses are bridged, and a hand that
// comes back elsewhere, or from another tracker, glides there without pushing anything.
class PoseBlend {
  public:
    // seen: the newest pose there is. stretch: changes whenever seen may be elsewhere for no reason of the
    // hand's (HandFilter::stretch(), another source); 0: never seen. notSeen_s: since seen was renewed.
    const HandPose& step(const HandPose& seen, int stretch, float notSeen_s, float dt_s);

    // Of a source that needs none of this: its pose is given out as it is, and glided away from later.
    void take(const HandPose& pose) { pose_ = pose; }

    const HandPose& pose() const { return pose_; }

  private:
    HandPose pose_; // as given out
    HandPose from_; // where a glide began
    int stretch_ = 0;
    float glideLength_s_ = 0;
    float glide_s_ = 0;  // left
    float appear_s_ = 0; // left
};

// Between two poses of the same hand; everything that is not a joint comes from b.
HandPose between(const HandPose& a, const HandPose& b, float share);

class HandSourceSelector {
  public:
    // Once a tick, after the device has advanced for the frame: takes the mouse's hands and gives those
    // chosen. ago_s: of the tick, before the frame's time. A device's hand is where it is predicted to be
    // then, and moves on so from tick to tick; by as much as that was wrong it is corrected evenly, over the
    // interval of the device's frames, so that it does not leap. (Murphy 2011, "Believable Dead Reckoning for
    // Networked Games", in Game Engine Gems 2, blends so between two predictions.)
    void tick(const DeviceHands& device, std::array<HandPose, 2>& hands, float ago_s, float dt_s);

    bool fromDevice() const { return fromDevice_; } // else the mouse's

  private:
    struct Hand {
        HandPose target; // predicted and corrected, or the mouse's
        int targetStretch = 0;
        float sinceFrame_s = 0; // since the first tick with the device's last
        PoseBlend continuity;
    };
    bool fromDevice_ = false;
    bool everFromDevice_ = false; // until then the mouse's hands pass as they are
    std::array<Hand, 2> hands_;
};

} // namespace shoal::hands
