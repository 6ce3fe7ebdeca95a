// Filtering of one tracked hand: a one-euro filter per joint, and grip and pinch with hysteresis.
#pragma once

#include "input/hands/HandTracker.h"
#include "input/hands/HandTuning.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace shoal::hands {

// Share of the way to a new value that a first-order low-pass goes in dt_s: equations 3 to 5 of the paper
// below.
float smoothing(float cutoff_Hz, float dt_s);

// The one-euro filter: a low-pass whose cut-off grows with speed, so that a still hand does not tremble and a
// moving one does not lag. Casiez, Roussel, Vogel 2012, "1 Euro Filter: A Simple Speed-based Low-pass Filter
// for Noisy Input in Interactive Systems", algorithm 1. Departs from the paper in one thing: the three
// coordinates share the cut-off that follows from the length of their speed, so that a motion's direction is
// kept. Value: a point (m, m/s), or a unit quaternion, whose way is the great arc (rad/s in the turning
// frame).
template <class Value> class OneEuro {
  public:
    explicit OneEuro(const OneEuroTuning& tuning) : tuning_(tuning) {}
    void reset(const Value& value);
    const Value& step(const Value& value, float dt_s); // dt_s <= 0: nothing new
    const Value& value() const { return value_; }

  private:
    OneEuroTuning tuning_;
    Value value_{}, raw_{};
    glm::vec3 speed_{0}; // itself low-passed
};
using OneEuroPoint = OneEuro<glm::vec3>;
using OneEuroTurn = OneEuro<glm::quat>;

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
    std::vector<OneEuroPoint> palmFromJoint_; // by joint
    std::vector<OneEuroTurn> palmFromJointTurn_;
    GestureLatch latch_;
    Gesture gesture_ = Gesture::Open;
    int64_t identity_ = 0;
    int stretch_ = 0;
};

} // namespace shoal::hands
