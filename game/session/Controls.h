// Input of mouse, keys and gamepad as actions, by the player's bindings. Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "game/texts/Texts.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numbers>
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
    Bindings() { // the defaults
        for (size_t i = 0; i < kActions; ++i) bound_[i] = {kActionRows[i].keys, kActionRows[i].button};
    }

    struct Keys {
        std::array<int, 2> keys;
        int button;
    };
    const Keys& of(Action action) const { return bound_[static_cast<size_t>(action)]; }

    // Binds a key in place of the action's first, or a button. Returns the action that loses it.
    std::optional<Action> bind(Action action, int number, bool isButton);

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
    platform::WindowInput input;
    std::bitset<kActions> down, pressed;

    bool isDown(Action action) const { return down[static_cast<size_t>(action)]; }
    bool wasPressed(Action action) const { return pressed[static_cast<size_t>(action)]; }
    // Returns 1 if only the first is held down, -1 if only the second is, else 0.
    float axis(Action plus, Action minus) const {
        return static_cast<float>(isDown(plus)) - static_cast<float>(isDown(minus));
    }
    // Returns the mouse's movement with its right button down, pixels.
    glm::dvec2 dragged() const { return input.rightButton ? input.cursorMoved : glm::dvec2(0); }
};

// Direction of a view that the player turns by hand: yaw about the world's up, then pitch.
struct LookAngles {
    static constexpr float kPitchMax_rad = 1.45f;

    float yaw_rad = 0, pitch_rad = 0; // to the right, up

    static LookAngles of(const glm::quat& worldFromView) {
        const glm::vec3 ahead = worldFromView * glm::vec3(0, 0, -1);
        LookAngles angles;
        angles.turnBy({std::atan2(ahead.x, -ahead.z), std::asin(std::clamp(ahead.y, -1.0f, 1.0f))});
        return angles;
    }
    void turnBy(glm::vec2 rad) { // +x right, +y up
        yaw_rad = std::remainder(yaw_rad + rad.x, 2 * std::numbers::pi_v<float>);
        pitch_rad = std::clamp(pitch_rad + rad.y, -kPitchMax_rad, kPitchMax_rad);
    }
    glm::quat worldFromView() const {
        return glm::angleAxis(-yaw_rad, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch_rad, glm::vec3(1, 0, 0));
    }
};

constexpr float kDragTurn_rad = 0.0032f; // turn of the view for a pixel that the mouse is dragged

// Polls the window.
Controls readControls(platform::Window& window, const Bindings& bindings);

} // namespace shoal::app
