// Turns what the player does with mouse, keys, gamepad or a fingertip into input for a menu. Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "engine/scene/HandPose.h"
#include "game/ui/Menu.h"

#include <array>

namespace shoal::app {

// A fingertip that moves forward by a few centimetres presses what it points at. A slow mean of its distance
// is what "forward" is measured from, so that it works wherever the hand is held.
class FingerPoke {
  public:
    // tip: of the index finger, viewer's frame, metres. tanHalf: tangents of half the picture's angles.
    void step(const hands::HandPose& hand, glm::vec2 tanHalf, float dt_s);

    bool pointing() const { return pointing_; }
    glm::vec2 at() const { return at_; } // 0 to 1 from the picture's upper left
    bool pressed() const { return pressed_; }
    bool held() const { return held_; }

    static constexpr float kPress_m = 0.025f, kRelease_m = 0.012f;
    static constexpr float kMean_s = 0.35f;

  private:
    bool pointing_ = false, pressed_ = false, held_ = false;
    float mean_m_ = 0;
    glm::vec2 at_{0};
};

class MenuControls {
  public:
    // input: null without a window. size: of the picture that the menu is drawn on; eyes: how many of them
    // stand side by side in the window.
    MenuInput step(const platform::WindowInput* input, const platform::Window* window,
                   const std::array<hands::HandPose, 2>& hands, glm::vec2 tanHalf, glm::vec2 size, int eyes,
                   float dt_s);

    // Where a finger points, to be shown; empty: no hand points.
    std::optional<glm::vec2> finger() const { return finger_; }

  private:
    glm::ivec2 held_{0}; // direction that keys or stick hold: +x right, +y down
    float repeat_s_ = 0; // until it counts again
    std::array<FingerPoke, 2> pokes_;
    std::optional<glm::vec2> finger_;
};

} // namespace shoal::app
