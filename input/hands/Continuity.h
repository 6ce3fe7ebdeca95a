// What the simulation gets of one hand, tick by tick: short losses are bridged, and a hand that comes back
// elsewhere, or from another device, glides there without pushing anything.
#pragma once

#include "input/hands/HandPose.h"

namespace shoal::hands {

class Continuity {
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

} // namespace shoal::hands
