// The constants of filtering, bridging of losses and gesture recognition of tracked hands. Each has its test
// in tests/unit/hands/TuningTest.cpp.
#pragma once

namespace shoal::hands {

// Of a one-euro filter; the slope is in Hz per unit of speed (m/s or rad/s).
struct OneEuroTuning {
    float minCutoff_Hz;
    float slope;
    float speedCutoff_Hz;
};

namespace tuning {

// Filtering: more slope, less latency in motion; less cut-off, less jitter at rest.
constexpr OneEuroTuning kPosition{4.0f, 80.0f, 4.0f};   // m/s; of the palm in the viewer's frame
constexpr OneEuroTuning kFinger{4.0f, 60.0f, 4.0f};     // m/s; of the other joints in the palm's frame
constexpr OneEuroTuning kOrientation{4.0f, 3.0f, 4.0f}; // rad/s; of every joint

// Losses.
constexpr float kBridge_s = 0.3f;     // a hand not seen for so long is still where it was
constexpr float kFastest_mps = 25.0f; // a palm that seems faster than this is another hand
constexpr float kJump_m = 0.10f;      // besides what kFastest_mps allows
constexpr float kGap_s = 0.1f;        // frames farther apart than this are not filtered together

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
} // namespace shoal::hands
