// Size of a player's hand relative to the rig's. One camera cannot tell it, because a hand looks like a
// larger one that is farther away in proportion. So a player may have it measured at a known distance.
#pragma once

#include "input/hands/HandTracker.h"

namespace shoal::hands {

constexpr double kHandSizeMin = 0.7, kHandSizeMax = 1.4; // a child's, a giant's; also the setting's range

// Scales a hand of the rig's size, in the camera's frame, to the one of this size that looks the same.
void resize(HandPose& hand, float size);

// Measures the size of a hand that is held open and still at kAt_m from the camera.
class HandSizing {
  public:
    static constexpr float kAt_m = 0.3f;      // distance of the palm: the length of a sheet of A4 paper
    static constexpr float kHold_s = 1.5f;    // time for which it is held
    static constexpr float kSpread = 0.06f;   // greatest change of its distance, as a share
    static constexpr float kMissing_s = 0.2f; // a hand that is not seen for this long has gone

    enum class State { Waiting, Elsewhere, Holding, Done }; // Elsewhere: the hand is not at kAt_m

    // Takes a frame. asRig_m: HandFrame::asRig_m, if just one hand is seen and it is open; else empty.
    void see(std::optional<float> asRig_m, float dt_s);

    State state() const { return state_; }
    float progress() const { return state_ == State::Done ? 1.0f : held_s_ / kHold_s; }
    std::optional<float> size() const; // once it is done

  private:
    void begin(float asRig_m);

    State state_ = State::Waiting;
    float held_s_ = 0, missing_s_ = 0;
    float least_m_ = 0, most_m_ = 0, sum_m_ = 0;
    int seen_ = 0; // frames in sum_m_
};

} // namespace shoal::hands
