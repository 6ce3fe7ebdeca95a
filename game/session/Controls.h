// Input of mouse, keys and gamepad as actions, by the player's bindings. Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "game/texts/Texts.h"

#include <array>
#include <bitset>
#include <optional>
#include <string>
#include <string_view>

namespace shoal::app {

enum class Action {
    CloseHand,
    LookLeft,
    LookRight,
    LookUp,
    LookDown,
    Farther,
    Nearer,
    SwapHands,
    Recentre,
    Pause,
    Louder,
    Quieter,
    Fullscreen,
    Performance,
    Room,
};
inline constexpr size_t kActions = 15;

struct ActionRow {
    const char* name; // in the settings file
    game::Text label;
    std::array<int, 2> keys; // GLFW_KEY_*; -1: none
    int button;              // GLFW_GAMEPAD_BUTTON_*; -1: none
};
// The actions with their default keys and buttons, in the order of the enumeration.
extern const std::array<ActionRow, kActions> kActionRows;

class Bindings {
  public:
    Bindings(); // the defaults

    struct Keys {
        std::array<int, 2> keys;
        int button;
    };
    const Keys& of(Action action) const { return bound_[static_cast<size_t>(action)]; }

    // Binds a key, or a button, in place of the action's first. Returns the action that loses it.
    std::optional<Action> bindKey(Action action, int key);
    std::optional<Action> bindButton(Action action, int button);

    // Reads bindings as in the settings file: "close=Space,- A; pause=Escape,P Start". Other actions keep
    // theirs. Returns false, and changes nothing, if the text is malformed.
    bool parse(std::string_view text);
    std::string toText() const;

  private:
    std::array<Keys, kActions> bound_;
};

std::string keyName(int key);            // "-": none
std::string_view buttonName(int button); // "-": none

// The input of one frame.
struct Controls {
    std::bitset<kActions> down, pressed;
    glm::dvec2 cursor{0.5};      // 0 to 1 from the window's upper left
    glm::dvec2 dragged{0};       // mouse movement with its right button down, pixels
    double wheel = 0;            // notches, away from the player positive
    bool mouseCloses = false;    // the left button
    bool turns = false;          // the right button
    glm::vec2 look{0}, reach{0}; // gamepad's sticks: -1 to 1, +x right, +y up
    float trigger = 0;           // gamepad's trigger, 0 to 1: how far the hand closes
    bool mouseMoved = false;

    bool is(Action action) const { return down[static_cast<size_t>(action)]; }
    bool was(Action action) const { return pressed[static_cast<size_t>(action)]; }
    // Returns 1 if only the first is held down, -1 if only the second is, else 0.
    float between(Action plus, Action minus) const {
        return static_cast<float>(is(plus)) - static_cast<float>(is(minus));
    }
};

Controls readControls(const platform::Window& window, const platform::WindowInput& input,
                      const Bindings& bindings);

} // namespace shoal::app
