// Filtering of one tracked hand: a one-euro filter per joint, prediction, and gestures with hysteresis.
#pragma once

#include "input/hands/HandTracker.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <numbers>
#include <vector>

namespace shoal::hands {

// Constants of a one-euro filter; the slope is in Hz per unit of speed (m/s or rad/s).
struct OneEuroTuning {
    float minCutoff_Hz;
    float slope;
    float speedCutoff_Hz;
};

// Constants of filtering, prediction, bridging and gestures; tests/unit/hands/TuningTest.cpp tests each.
namespace tuning {

// Filtering: a larger slope gives less latency in motion, a lower cut-off less jitter at rest.
constexpr OneEuroTuning kPosition{3.0f, 40.0f, 4.0f};   // m/s; of the palm in the viewer's frame
constexpr OneEuroTuning kFinger{4.0f, 60.0f, 4.0f};     // m/s; of the other joints in the palm's frame
constexpr OneEuroTuning kOrientation{4.0f, 3.0f, 4.0f}; // rad/s; of every joint

// Prediction: a larger slope gives less lag behind a hand that changes its velocity, a lower cut-off less
// jitter at rest.
struct VelocityTuning {
    float minCutoff_Hz;
    float slope; // Hz per unit of velocity
    float farthest;
};
constexpr VelocityTuning kPalmVelocity{0.5f, 40.0f, 0.15f}; // m/s, m
constexpr VelocityTuning kPalmSpin{0.5f, 4.0f, 0.5f}; // rad/s, rad; as kPalmVelocity, 0.1 m from the wrist
// Time in which a predicted hand slows down evenly to rest. A longer time gives less lag, but more overshoot
// when the real hand stops at once.
constexpr float kStops_s = 0.15f;
// A prediction's error is corrected within an interval of the device's frames, but within this at least.
constexpr float kCorrect_s = 1.0f / 60;

constexpr float kFastest_mps = 25.0f; // a palm that seems faster than this is another hand
constexpr float kJump_m = 0.10f;      // distance allowed in addition to that at kFastest_mps

constexpr float kMouseReturns_s = 1; // a device that sees no hand for this long leaves the game to the mouse

// A hand that comes back glides to where it is seen, and pushes nothing meanwhile.
constexpr float kGlide_mps = 2.0f;  // mean speed; its peak is 1.5 times that, below what tears a fish loose
constexpr float kGlideMin_s = 0.1f; // however near
constexpr float kGlideMax_s = 0.5f; // however far
constexpr float kNear_m = 0.03f;    // nearer than this it stays solid: nobody sees it glide
constexpr float kAppear_s = 0.15f;  // time for which a hand that was not there before is not solid

// Gestures, beside kGripCloses and kGripOpens.
constexpr float kPinchCloses = 0.75f;
constexpr float kPinchOpens = 0.55f;
constexpr float kPinchToFist = 0.80f; // grip that turns a pinch into a fist without opening first
// Least strength reported while closed, and greatest while open: they lie beyond the thresholds, so that all
// readers decide alike.
constexpr float kClosedMin = 0.60f, kOpenMax = 0.30f;
constexpr float kStrengthTau_s = 0.01f; // smoothing of the strengths, time constant

} // namespace tuning

// Returns the share of the way to a new value that a first-order low-pass goes in dt_s: equations 3 to 5 of
// the paper below.
constexpr float smoothing(float cutoff_Hz, float dt_s) {
    const float r = 2 * std::numbers::pi_v<float> * cutoff_Hz * dt_s;
    return r / (r + 1);
}

// The one-euro filter: a low-pass whose cut-off grows with speed, so that a still hand does not tremble and a
// moving one does not lag. Casiez, Roussel, Vogel 2012, "1 Euro Filter: A Simple Speed-based Low-pass Filter
// for Noisy Input in Interactive Systems", algorithm 1. Unlike in the paper the three coordinates share a
// cut-off, by the length of their speed, so that a motion keeps its direction. Value: a point (m, m/s), or a
// unit quaternion, whose way is the great arc (rad/s in the turning frame).
template <class Value> class OneEuro {
  public:
    explicit OneEuro(const OneEuroTuning& tuning) : tuning_(tuning) {}
    void reset(const Value& value);
    const Value& step(const Value& value, float dt_s); // dt_s <= 0: nothing new
    const Value& value() const { return value_; }
    float lag_s() const { return lag_s_; } // of value() behind a value that moves steadily

  private:
    OneEuroTuning tuning_;
    Value value_{}, raw_{};
    glm::vec3 speed_{0}; // itself low-passed
    float lag_s_ = 0;
};
using OneEuroPoint = OneEuro<glm::vec3>;
using OneEuroTurn = OneEuro<glm::quat>;

// Dead reckoning: predicts a filtered value by a velocity that falls to 0 within kStops_s. The velocity is
// low-passed, with a cut-off that grows with its magnitude, as in the one-euro filter. A value that slows
// down is expected to lose as much speed again; otherwise a hand that stops would be drawn beyond its place.
template <class Value> class DeadReckoning {
  public:
    explicit DeadReckoning(const tuning::VelocityTuning& tuning) : tuning_(tuning) {}
    void reset() { velocity_ = used_ = glm::vec3(0); }
    void step(const Value& from, const Value& to, float dt_s); // the value's last step; dt_s <= 0: none
    Value ahead(const Value& value, float ahead_s) const;      // ahead_s < 0: the past

  private:
    tuning::VelocityTuning tuning_;
    glm::vec3 velocity_{0}, used_{0};
};

enum class Gesture { Open, Pinch, Fist };

// Decides with hysteresis which gesture a hand makes, from the strengths that a tracker measures.
class GestureLatch {
  public:
    // Keeps the strength of the decided gesture at kClosedMin or above, and the others at kOpenMax or below.
    Gesture step(float& grip, float& pinch, float dt_s);

  private:
    Gesture gesture_ = Gesture::Open;
    float grip_ = 0, pinch_ = 0;
    bool begun_ = false;
};

// Moves a whole hand as its palm moves.
HandPose carried(const HandPose& hand, const JointPose& from, const JointPose& to);

// Filter of one hand. The palm is filtered in the viewer's frame and every other joint in the palm's, so that
// fingers do not trail behind a moving hand; bones keep the length that the device gave them.
class HandFilter {
  public:
    // Takes a frame of the device; a hand that is not plausible() counts as not seen.
    void step(const HandPose& seen, int64_t identity, int64_t time_us);

    const HandPose& pose() const { return pose_; } // of the last time it was seen
    bool seen() const { return pose_.tracked; }    // in the last frame
    Gesture gesture() const { return gesture_; }
    int stretch() const { return stretch_; } // number of the stretch of unbroken tracking
    // Time between the last two frames that saw the hand; 0: the stretch of tracking begins with the last.
    float interval_s() const { return interval_s_; }

    // Predicts the palm at that time after the hand was last seen, without the filter's lag.
    JointPose palm(float after_s) const;

  private:
    HandPose pose_, raw_;
    OneEuroPoint palm_{tuning::kPosition};
    OneEuroTurn palmTurn_{tuning::kOrientation};
    DeadReckoning<glm::vec3> palmMotion_{tuning::kPalmVelocity};
    DeadReckoning<glm::quat> palmSpin_{tuning::kPalmSpin};
    std::vector<OneEuroPoint> palmFromJoint_{kJointCount, OneEuroPoint(tuning::kFinger)}; // by joint
    std::vector<OneEuroTurn> palmFromJointTurn_{kJointCount, OneEuroTurn(tuning::kOrientation)};
    GestureLatch latch_;
    Gesture gesture_ = Gesture::Open;
    int64_t identity_ = 0;
    int stretch_ = 0;
    float interval_s_ = 0;
};

} // namespace shoal::hands
