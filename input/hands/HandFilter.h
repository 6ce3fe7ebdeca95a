// Filtering of one tracked hand: a one-euro filter per joint, and grip and pinch with hysteresis.
#pragma once

#include "input/hands/HandTracker.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace shoal::hands {

// The constants of filtering, bridging of losses and gesture recognition. Each has its test in
// tests/unit/hands/TuningTest.cpp.

// Of a one-euro filter; the slope is in Hz per unit of speed (m/s or rad/s).
struct OneEuroTuning {
    float minCutoff_Hz;
    float slope;
    float speedCutoff_Hz;
};

namespace tuning {

// Filtering: more slope, less latency in motion; less cut-off, less jitter at rest.
constexpr OneEuroTuning kPosition{3.0f, 40.0f, 4.0f};   // m/s; of the palm in the viewer's frame
constexpr OneEuroTuning kFinger{4.0f, 60.0f, 4.0f};     // m/s; of the other joints in the palm's frame
constexpr OneEuroTuning kOrientation{4.0f, 3.0f, 4.0f}; // rad/s; of every joint

// Prediction. Of the velocities: more slope, less lag behind a hand that changes its mind; less cut-off, less
// jitter at rest.
struct VelocityTuning {
    float minCutoff_Hz;
    float slope; // Hz per unit of velocity
    float farthest;
};
constexpr VelocityTuning kPalmVelocity{0.5f, 40.0f, 0.15f}; // m/s, m
constexpr VelocityTuning kPalmSpin{0.5f, 4.0f, 0.5f}; // rad/s, rad; as kPalmVelocity, 0.1 m from the wrist
// A hand is taken to slow down evenly and to stop within so long: the longer, the less it lags, and the
// farther it goes on when it stops at once.
constexpr float kStops_s = 0.15f;
// A prediction that was wrong is corrected within an interval of the device's, but not faster than this.
constexpr float kCorrect_s = 1.0f / 60;

// Losses.
constexpr float kBridge_s = 0.3f;     // a hand not seen for so long is still where it was
constexpr float kFastest_mps = 25.0f; // a palm that seems faster than this is another hand
constexpr float kJump_m = 0.10f;      // besides what kFastest_mps allows
constexpr float kGap_s =
    kBridge_s; // frames farther apart are not filtered together; devices give 5 to 200 Hz

constexpr float kMouseReturns_s = 1; // a device that sees no hand for so long leaves the game to the mouse

// Coming back: the hand glides to where it is seen, and pushes nothing meanwhile.
constexpr float kGlide_mps = 2.0f;  // mean speed; its peak is 1.5 times that, below what tears a fish loose
constexpr float kGlideMin_s = 0.1f; // however near
constexpr float kGlideMax_s = 0.5f; // however far
constexpr float kNear_m = 0.03f;    // nearer than this it stays solid: nobody sees it glide
constexpr float kAppear_s = 0.15f;  // a hand that comes out of nothing is not solid for so long

// Gestures: a hand closes above the first, opens below the second; between them it stays what it was.
constexpr float kGripCloses = 0.55f;
constexpr float kGripOpens = 0.35f;
constexpr float kPinchCloses = 0.75f;
constexpr float kPinchOpens = 0.55f;
constexpr float kPinchToFist = 0.80f; // grip that turns a pinch into a fist without opening first
constexpr float kClosedMin = 0.60f;   // strength reported at least while closed...
constexpr float kOpenMax =
    0.30f; // ...and at most while open, so that readers need no hysteresis of their own
constexpr float kStrengthTau_s = 0.01f; // smoothing of the strengths, time constant

} // namespace tuning

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
    float lag_s() const { return lag_s_; } // of value() behind one that moves steadily

  private:
    OneEuroTuning tuning_;
    Value value_{}, raw_{};
    glm::vec3 speed_{0}; // itself low-passed
    float lag_s_ = 0;
};
using OneEuroPoint = OneEuro<glm::vec3>;
using OneEuroTurn = OneEuro<glm::quat>;

// Dead reckoning: where a filtered value will be, by a velocity that falls to nothing within kStops_s. It is
// low-passed with a cut-off that grows with it, as in the one-euro filter. What slows down is taken to lose
// as much again, or a hand that stops would be drawn beyond.
template <class Value> class DeadReckoning {
  public:
    explicit DeadReckoning(const tuning::VelocityTuning& tuning) : tuning_(tuning) {}
    void reset() { velocity_ = used_ = glm::vec3(0); }
    void step(const Value& from, const Value& to,
              float dt_s); // the value went so far; dt_s <= 0: nothing new
    // ahead_s < 0: where it was.
    Value ahead(const Value& value, float ahead_s) const;

  private:
    tuning::VelocityTuning tuning_;
    glm::vec3 velocity_{0}, used_{0};
};

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

// Where a hand's palm joint is.
struct Palm {
    glm::vec3 position{0};
    glm::quat turn{1, 0, 0, 0};
};
// The whole hand goes with its palm.
HandPose carried(const HandPose& hand, const Palm& from, const Palm& to);

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
    // From the frame before to the last one in which it was seen, seconds, at most kGap_s; 0: the stretch
    // begins with that one.
    float interval_s() const { return interval_s_; }

    // Where its palm will be, so long after the last time that it was seen: predicted, the filter's lag
    // made good.
    Palm palm(float after_s) const;

  private:
    bool continues(const HandPose& seen, int64_t identity, float dt_s) const;

    HandPose pose_, raw_;
    OneEuroPoint palm_;
    OneEuroTurn palmTurn_;
    DeadReckoning<glm::vec3> palmMotion_;
    DeadReckoning<glm::quat> palmSpin_;
    std::vector<OneEuroPoint> palmFromJoint_; // by joint
    std::vector<OneEuroTurn> palmFromJointTurn_;
    GestureLatch latch_;
    Gesture gesture_ = Gesture::Open;
    int64_t identity_ = 0;
    int stretch_ = 0;
    float interval_s_ = 0;
};

} // namespace shoal::hands
