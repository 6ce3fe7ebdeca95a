// The hands of a tracker, filtered, on the game's clock; and the choice of the game's hands: the tracker's
// while it sees any, else the mouse's.
#pragma once

#include "input/hands/HandFilter.h"

#include <limits>
#include <optional>

namespace shoal::hands {

// Time when a device's frames are used. Live: on arrival. Stamps: when the game's time reaches their stamps;
// the game waits for them, so that the same recording always gives the same game.
enum class DeviceTime { Live, Stamps };

class DeviceHands {
  public:
    explicit DeviceHands(DeviceTime time) : time_(time) {}

    // Takes the stream's frames for the elapsed_s seconds of the game's time that end now.
    void advance(HandStream& stream, double elapsed_s, Clock::time_point now);

    const HandFilter& hand(int side) const { return filters_[side]; }
    float notSeen_s(int side) const { return notSeen_s_[side]; } // since last seen
    // Age of hand()'s pose: notSeen_s() plus the time from its picture to its arrival here.
    float age_s(int side) const { return notSeen_s(side) + lateness_s_[side]; }
    // HandFrame's values, when the hand was seen last.
    glm::vec3 towardsElbow(int side) const { return towardsElbow_[side]; }
    float rigDistance_m(int side) const { return rigDistance_m_[side]; }
    bool seesHands(float within_s) const { return notSeen_s_[0] <= within_s || notSeen_s_[1] <= within_s; }

  private:
    bool due(HandStream& stream, HandFrame& frame);

    DeviceTime time_;
    std::array<HandFilter, 2> filters_;
    std::array<float, 2> notSeen_s_{1e6f, 1e6f};
    std::array<float, 2> lateness_s_{};
    std::array<glm::vec3, 2> towardsElbow_{};
    std::array<float, 2> rigDistance_m_{};
    // Used for DeviceTime::Stamps.
    int64_t game_us_ = 0;
    int64_t gameFromDevice_us_ = 0;
    int64_t last_us_ = std::numeric_limits<int64_t>::max(); // by the device's clock
    std::optional<HandFrame> ahead_; // a frame taken from the stream whose time is still to come
    bool silent_ = false;            // nothing came in time: no further wait until something does
};

// The pose of one hand in the simulation, tick by tick: short losses are bridged, and a hand that comes back
// elsewhere, or from another tracker, glides there without pushing anything.
class PoseBlend {
  public:
    // seen: the newest pose. stretch: changes when that pose does not continue the one before
    // (HandFilter::stretch(), another source); 0: never seen. notSeen_s: age of that pose.
    const HandPose& step(const HandPose& seen, int stretch, float notSeen_s, float dt_s);

    // Takes the pose of a source that needs no bridging; a later glide begins there.
    void take(const HandPose& pose) { pose_ = pose; }

    const HandPose& pose() const { return pose_; }

  private:
    HandPose pose_; // as given out
    HandPose from_; // the pose at the beginning of a glide
    int stretch_ = 0;
    float glideLength_s_ = 0;
    float glide_s_ = 0;  // left
    float appear_s_ = 0; // left
};

// Interpolates between two poses of a hand; everything that is not a joint comes from b.
HandPose between(const HandPose& a, const HandPose& b, float share);

class HandSourceSelector {
  public:
    // Takes the mouse's hands and returns those chosen; once a tick, after the device has advanced for the
    // frame. ago_s: time from the tick to the frame. A device's hand moves as predicted; the prediction's
    // error is corrected evenly over the interval of the device's frames, so that the hand does not leap
    // (Murphy 2011, "Believable Dead Reckoning for Networked Games", in Game Engine Gems 2).
    void tick(const DeviceHands& device, std::array<HandPose, 2>& hands, float ago_s, float dt_s);

    bool fromDevice() const { return fromDevice_; } // else the mouse's

  private:
    struct Hand {
        HandPose target; // predicted and corrected, or the mouse's
        int targetStretch = 0;
        float sinceFrame_s = 0; // time since the first tick with the device's last frame
        PoseBlend continuity;
    };
    bool fromDevice_ = false;
    bool everFromDevice_ = false; // until then the mouse's hands pass as they are
    std::array<Hand, 2> hands_;
};

} // namespace shoal::hands
