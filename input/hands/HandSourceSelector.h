// Selection of the hands that the game gets: those of the best tracker that sees any, else the mouse's.
#pragma once

#include "input/hands/DeviceHands.h"

#include <span>

namespace shoal::hands {

// The pose that the simulation gets of one hand, tick by tick: short losses are bridged, and a hand that
// comes back elsewhere, or from another tracker, glides there without pushing anything.
class PoseBlend {
  public:
    // seen: the newest pose there is. stretch: changes whenever seen may be elsewhere for no reason of the
    // hand's (HandFilter::stretch(), another device); 0: never seen. notSeen_s: since seen was renewed.
    const HandPose& step(const HandPose& seen, int stretch, float notSeen_s, float dt_s);

    // Of a source that needs none of this: its pose is given out as it is, and glided away from later.
    void take(const HandPose& pose) { pose_ = pose; }

    const HandPose& pose() const { return pose_; }
    bool gliding() const { return glide_s_ > 0; }

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
    static constexpr int kMouse = -1;

    // Once a frame of the display, after the devices have advanced; the best comes first.
    void frame(std::span<const DeviceHands* const> devices);

    // Once a tick: takes the mouse's hands and gives those chosen. ticksLeft: of this frame, this one among
    // them; what came since the last frame is spread over them, so that a hand moves evenly.
    void tick(std::array<HandPose, 2>& hands, int ticksLeft, float dt_s);

    int chosen() const { return chosen_; } // index into the devices, or kMouse

  private:
    struct Hand {
        HandPose newest; // of the device chosen
        int stretch = 0;
        float notSeen_s = 0;
        HandPose target; // on the way to the newest
        int targetStretch = 0;
        PoseBlend continuity;
    };
    int chosen_ = kMouse;
    bool everChosen_ = false; // a device: until then the mouse's hands pass as they are
    int changes_ = 0;
    std::array<Hand, 2> hands_;
};

} // namespace shoal::hands
