// Turns what the player does with mouse, keys, gamepad or a fingertip into input for a menu. Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "engine/scene/HandPose.h"
#include "game/ui/Menu.h"

#include <array>

namespace shoal::app {

// The picture that menus are drawn on.
struct MenuSurface {
    glm::vec2 size{1}; // pixels
    int eyes = 1;      // how many such pictures stand side by side in the window
    bool mouse = true; // the window's pointer points at it
};

// Where a hand's fingertip is before that picture.
struct Pointing {
    bool points = false;
    glm::vec2 at{0.5f};  // 0 to 1 from the picture's upper left
    float forward_m = 0; // towards the picture, from anywhere that stays
    bool pulls = false;  // a controller's trigger, which presses too
};
// Of a picture that fills the view. tanHalf: tangents of half its angles.
Pointing pointingInView(const hands::HandPose& hand, glm::vec2 tanHalf);

// A fingertip that moves forward by a few centimetres presses what it points at. A slow mean of its distance
// is what "forward" is measured from, so that it works wherever the hand is held.
class FingerPoke {
  public:
    void step(const Pointing& finger, float dt_s);

    bool pointing() const { return pointing_; }
    glm::vec2 at() const { return at_; } // 0 to 1 from the picture's upper left
    bool pressed() const { return pressed_; }
    bool held() const { return held_; }

    static constexpr float kPress_m = 0.025f, kRelease_m = 0.012f;
    static constexpr float kMean_s = 0.35f;

  private:
    bool pointing_ = false, pressed_ = false, held_ = false, pulled_ = false;
    float mean_m_ = 0;
    glm::vec2 at_{0}, steady_{0}; // steady: before it moved forward
};

class MenuControls {
  public:
    // input: null without a window. fingers: of the left and the right hand.
    MenuInput step(const platform::WindowInput* input, const platform::Window* window,
                   const std::array<Pointing, 2>& fingers, const MenuSurface& surface, float dt_s);

    // Where a finger points, to be shown; empty: no hand points.
    std::optional<glm::vec2> finger() const { return finger_; }

    // After keys, gamepad or mouse fingers rest for so long: a tracker may see the hand that uses these.
    static constexpr float kFingersRest_s = 2;

  private:
    glm::ivec2 held_{0}; // direction that keys or stick hold: +x right, +y down
    float repeat_s_ = 0; // until it counts again
    std::array<FingerPoke, 2> pokes_;
    float fingersRest_s_ = 0; // left
    std::optional<glm::vec2> finger_;
};

} // namespace shoal::app
