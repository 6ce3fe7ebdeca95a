// The size of a player's hand, in times of the rig's. One camera cannot tell it: a hand looks like a bigger
// one that is farther away by as much. So a player may have it measured at a known distance.
#pragma once

#include "input/hands/HandTracker.h"

namespace shoal::hands {

constexpr double kHandSizeMin = 0.7, kHandSizeMax = 1.4; // a child's, a giant's; of the setting too

// Scales a hand of the rig's size, in the camera's frame, to the one of this size that looks the same.
void resize(HandPose& hand, float size);

// Measures the size of a hand that is held open and still at kAt_m from the camera.
class HandSizing {
  public:
    static constexpr float kAt_m = 0.3f;      // the palm's; a sheet of A4 paper is as long
    static constexpr float kHold_s = 1.5f;    // time for which it is held
    static constexpr float kSpread = 0.06f;   // greatest change of its distance, as a share
    static constexpr float kMissing_s = 0.2f; // a hand not seen for so long has gone

    enum class State { Waiting, Elsewhere, Holding, Done }; // Elsewhere: no hand is so small or so big

    // Takes a frame. asRig_m: HandFrame's, of the only hand that is seen, if that is open; else empty.
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
