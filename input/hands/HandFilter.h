// Filtering of one tracked hand: a one-euro filter per joint, and grip and pinch with hysteresis.
#pragma once

#include "input/hands/HandTracker.h"
#include "input/hands/OneEuro.h"

namespace shoal::hands {

enum class Gesture { Open, Pinch, Fist };

// Decides with hysteresis from the strengths that a tracker measures which gesture a hand makes, once for all
// readers.
class GestureLatch {
  public:
    void reset() { *this = {}; }
    // Changes grip and pinch so that they lie clearly on the side decided: below kOpenMax or above
    // kClosedMin; at most one of them closed.
    Gesture step(float& grip, float& pinch, float dt_s);

  private:
    Gesture gesture_ = Gesture::Open;
    float grip_ = 0, pinch_ = 0;
    bool begun_ = false;
};

// One hand. The palm is filtered in the viewer's frame and every other joint in the palm's, so that fingers
// do not trail behind a moving hand; bones keep the length that the device gave them.
class HandFilter {
  public:
    HandFilter();

    // One frame of the device; hands whose joints cannot be are taken as not seen.
    void step(const HandPose& seen, int64_t identity, int64_t time_us);

    const HandPose& pose() const { return pose_; } // of the last time it was seen
    bool seen() const { return pose_.tracked; }    // in the last frame
    Gesture gesture() const { return gesture_; }
    // Counts stretches of unbroken tracking: another number, another place.
    int stretch() const { return stretch_; }

  private:
    bool continues(const HandPose& seen, int64_t identity, float dt_s) const;

    HandPose pose_, raw_;
    OneEuroPoint palm_;
    OneEuroTurn palmTurn_;
    std::array<OneEuroPoint, kJointCount> palmFromJoint_;
    std::array<OneEuroTurn, kJointCount> palmFromJointTurn_;
    GestureLatch latch_;
    Gesture gesture_ = Gesture::Open;
    int64_t identity_ = 0;
    int stretch_ = 0;
};

} // namespace shoal::hands
