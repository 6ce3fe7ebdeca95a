// Pauses and resumes a dive in a headset, whose player may have bare hands only. The dive pauses when the
// headset is taken off or loses the head's orientation; closed hands are the player's answers. Has no clock.
#pragma once

#include <array>

namespace shoal::app {

struct HeadsetMoment {
    bool plays = false;                // the headset is worn and shows no menus of its own
    bool headTracked = false;          // the head's orientation is known
    bool menu = false;                 // a controller's menu button is down
    bool results = false;              // the dive is over
    std::array<float, 2> grip{-1, -1}; // 0 open to 1 fist; negative: that hand is not seen
};

class HeadsetPause {
  public:
    // Updates `paused`, which a key may have changed too, once a frame. Sets `restart` when both hands have
    // been closed while the results are shown.
    //
    // Taking the headset off pauses until a hand is closed; losing the head pauses until it is tracked again.
    void step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    // Darkness of the picture, 0 to 1 (black): rises smoothly while the head is not tracked.
    float fade() const { return fade_; }

    static constexpr float kFist = 0.7f, kOpen = 0.4f; // grip above and below which a hand is closed and open
    static constexpr float kGoOn_s = 0.4f;             // time with one fist that ends a pause
    static constexpr float kAgain_s = 1.0f;            // time with both fists that starts another dive
    static constexpr float kSteady_s = 0.3f;           // time with a tracked head that ends its pause
    static constexpr float kFadeOut_s = 0.25f, kFadeIn_s = 0.5f;

  private:
    // Pauses while the headset is off or its head is not tracked.
    void followHeadset(const HeadsetMoment& now, float dt_s, bool& paused);
    // Reads closed hands as answers to a pause or the results.
    void readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    bool begun_ = false;    // the headset has been worn and tracked once
    bool byItself_ = false; // the present pause ends without an answer
    bool waiting_ = false;  // paused or over in the frame before
    bool menuWas_ = false;
    float steady_s_ = 0;
    std::array<bool, 2>
        opened_{}; // hands opened since the pause began: a hand that holds a fish does not end it
    std::array<float, 2> fist_s_{};
    float fade_ = 1;
};

} // namespace shoal::app
