// Pause control for a dive in a headset, whose player may have bare hands only: pauses when the headset is
// taken off or no longer knows which way the head looks, and reads closed hands as answers. Has no clock of
// its own.
#pragma once

#include <array>

namespace shoal::app {

struct HeadsetMoment {
    bool plays = false;                // the headset is worn and the runtime's own menus are away
    bool headTracked = false;          // it is known which way the head looks
    bool menu = false;                 // a controller's menu button is down
    bool results = false;              // the dive is over
    std::array<float, 2> grip{-1, -1}; // 0 open to 1 fist; negative: that hand is not seen
};

class HeadsetPause {
  public:
    // Once a frame. `paused` is read too, as a key may have changed it. Sets `restart` when both hands have
    // been closed while the results are shown.
    //
    // Taking the headset off pauses; closing a hand goes on. Losing the head pauses, and goes on by itself.
    void step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    // Darkness of the picture, 0 to 1 (black): rises smoothly while the head is not tracked.
    float fade() const { return fade_; }

    static constexpr float kFist = 0.7f, kOpen = 0.4f; // of grip
    static constexpr float kGoOn_s = 0.4f;             // one fist for so long ends a pause
    static constexpr float kAgain_s = 1.0f;            // both for so long start another dive
    static constexpr float kSteady_s = 0.3f;           // the head is known again for so long
    static constexpr float kFadeOut_s = 0.25f, kFadeIn_s = 0.5f;

  private:
    // Pauses when the headset is off or does not know the head, and goes on when it does again.
    void followHeadset(const HeadsetMoment& now, float dt_s, bool& paused);
    // The answers of closed hands.
    void readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    bool begun_ = false;    // has ever played
    bool byItself_ = false; // the pause ends when all is well again
    bool waiting_ = false;  // it was paused or over in the frame before
    bool menuWas_ = false;
    float steady_s_ = 0;
    std::array<bool, 2> opened_{}; // since the pause began: a hand that holds a fish ends none
    std::array<float, 2> fist_s_{};
    float fade_ = 1;
};

} // namespace shoal::app
