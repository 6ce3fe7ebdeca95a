// Converts input of mouse, keys, gamepad or a fingertip to menu input. Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "engine/scene/HandPose.h"
#include "game/ui/Menu.h"

#include <array>

namespace shoal::app {

// The picture that menus are drawn on.
struct MenuSurface {
    glm::vec2 size{1}; // pixels
    int eyes = 1;      // number of such pictures side by side in the window
    bool mouse = true; // the mouse's pointer acts on it
};

// A hand's fingertip in front of that picture.
struct Pointing {
    bool points = false;
    glm::vec2 at{0.5f};  // 0 to 1 from the picture's upper left
    float forward_m = 0; // distance towards the picture from any fixed place
    bool pulls = false;  // a controller's trigger is pulled, which presses too
};
// Returns the pointing for a picture that fills the view. tanHalf: tangents of half its angles.
Pointing pointingInView(const hands::HandPose& hand, glm::vec2 tanHalf);

// Detects presses: a fingertip that moves forward by a few centimetres presses at its place. "Forward" is
// relative to a slow mean of its distance, so that it works wherever the hand is held.
struct FingerPoke {
    void step(const Pointing& finger, float dt_s);

    bool pointing = false, pressed = false, held = false;
    glm::vec2 at{0}; // 0 to 1 from the picture's upper left

    static constexpr float kPress_m = 0.025f, kRelease_m = 0.012f;
    static constexpr float kMean_s = 0.35f;

  private:
    bool pulled_ = false;
    float mean_m_ = 0;
    glm::vec2 steady_{0}; // last position before it moved forward
};

class MenuControls {
  public:
    // Returns a frame's menu input. window: null in tests. fingers: of the left and the right hand.
    MenuInput step(const platform::WindowInput& input, const platform::Window* window,
                   const std::array<Pointing, 2>& fingers, const MenuSurface& surface, float dt_s);

    // Returns the place of the finger's mark; empty: no hand points.
    std::optional<glm::vec2> finger() const { return finger_; }

    // Time for which fingers are ignored after other input: a tracker may see the hand that gives it.
    static constexpr float kFingersRest_s = 2;

  private:
    glm::ivec2 held_{0}; // direction held by keys or stick: +x right, +y down
    float repeat_s_ = 0; // seconds until the held direction counts as another step
    std::array<FingerPoke, 2> pokes_;
    float fingersRest_s_ = 0; // seconds left
    std::optional<glm::vec2> finger_;
};

} // namespace shoal::app
