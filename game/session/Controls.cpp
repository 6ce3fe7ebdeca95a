#include "game/session/Controls.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace shoal::app {

const std::array<ActionRow, kActions> kActionRows = {{
    {Action::CloseHand, "close", "Close the hand", {GLFW_KEY_SPACE, -1}, GLFW_GAMEPAD_BUTTON_A},
    {Action::LookLeft, "look-left", "Look to the left", {GLFW_KEY_LEFT, GLFW_KEY_A}, -1},
    {Action::LookRight, "look-right", "Look to the right", {GLFW_KEY_RIGHT, GLFW_KEY_D}, -1},
    {Action::LookUp, "look-up", "Look up", {GLFW_KEY_UP, GLFW_KEY_W}, -1},
    {Action::LookDown, "look-down", "Look down", {GLFW_KEY_DOWN, GLFW_KEY_S}, -1},
    {Action::Farther,
     "farther",
     "Reach farther",
     {GLFW_KEY_E, GLFW_KEY_PAGE_UP},
     GLFW_GAMEPAD_BUTTON_DPAD_UP},
    {Action::Nearer,
     "nearer",
     "Reach nearer",
     {GLFW_KEY_C, GLFW_KEY_PAGE_DOWN},
     GLFW_GAMEPAD_BUTTON_DPAD_DOWN},
    {Action::SwapHands, "swap-hands", "Swap hands", {GLFW_KEY_TAB, -1}, GLFW_GAMEPAD_BUTTON_Y},
    {Action::Recentre, "recentre", "Look ahead again", {GLFW_KEY_HOME, -1}, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB},
    {Action::Pause, "pause", "Pause", {GLFW_KEY_ESCAPE, GLFW_KEY_P}, GLFW_GAMEPAD_BUTTON_START},
    {Action::Louder, "louder", "Louder", {GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD}, -1},
    {Action::Quieter, "quieter", "Quieter", {GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT}, -1},
    {Action::Fullscreen, "fullscreen", "Fullscreen", {GLFW_KEY_F11, -1}, -1},
    {Action::Performance, "performance", "Performance", {GLFW_KEY_F1, -1}, -1},
    {Action::Room, "room", "Your own room", {GLFW_KEY_F2, -1}, -1},
}};

namespace {

struct Named {
    int number;
    std::string_view name;
};
constexpr auto kKeyNames = std::to_array<Named>({
    {GLFW_KEY_SPACE, "Space"},
    {GLFW_KEY_APOSTROPHE, "'"},
    {GLFW_KEY_PERIOD, "."},
    {GLFW_KEY_SLASH, "/"},
    {GLFW_KEY_BACKSLASH, "\\"},
    {GLFW_KEY_LEFT_BRACKET, "["},
    {GLFW_KEY_RIGHT_BRACKET, "]"},
    {GLFW_KEY_GRAVE_ACCENT, "`"},
    {GLFW_KEY_EQUAL, "Plus"},
    {GLFW_KEY_MINUS, "Minus"},
    {GLFW_KEY_ESCAPE, "Escape"},
    {GLFW_KEY_ENTER, "Enter"},
    {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_BACKSPACE, "Backspace"},
    {GLFW_KEY_INSERT, "Insert"},
    {GLFW_KEY_DELETE, "Delete"},
    {GLFW_KEY_RIGHT, "Right"},
    {GLFW_KEY_LEFT, "Left"},
    {GLFW_KEY_DOWN, "Down"},
    {GLFW_KEY_UP, "Up"},
    {GLFW_KEY_PAGE_UP, "PageUp"},
    {GLFW_KEY_PAGE_DOWN, "PageDown"},
    {GLFW_KEY_HOME, "Home"},
    {GLFW_KEY_END, "End"},
    {GLFW_KEY_F1, "F1"},
    {GLFW_KEY_F2, "F2"},
    {GLFW_KEY_F3, "F3"},
    {GLFW_KEY_F4, "F4"},
    {GLFW_KEY_F5, "F5"},
    {GLFW_KEY_F6, "F6"},
    {GLFW_KEY_F7, "F7"},
    {GLFW_KEY_F8, "F8"},
    {GLFW_KEY_F9, "F9"},
    {GLFW_KEY_F10, "F10"},
    {GLFW_KEY_F11, "F11"},
    {GLFW_KEY_F12, "F12"},
    {GLFW_KEY_KP_ADD, "Keypad+"},
    {GLFW_KEY_KP_SUBTRACT, "Keypad-"},
    {GLFW_KEY_KP_ENTER, "KeypadEnter"},
    {GLFW_KEY_KP_0, "Keypad0"},
    {GLFW_KEY_KP_1, "Keypad1"},
    {GLFW_KEY_KP_2, "Keypad2"},
    {GLFW_KEY_KP_3, "Keypad3"},
    {GLFW_KEY_KP_4, "Keypad4"},
    {GLFW_KEY_KP_5, "Keypad5"},
    {GLFW_KEY_KP_6, "Keypad6"},
    {GLFW_KEY_KP_7, "Keypad7"},
    {GLFW_KEY_KP_8, "Keypad8"},
    {GLFW_KEY_KP_9, "Keypad9"},
    {GLFW_KEY_LEFT_SHIFT, "LeftShift"},
    {GLFW_KEY_RIGHT_SHIFT, "RightShift"},
    {GLFW_KEY_LEFT_CONTROL, "LeftControl"},
    {GLFW_KEY_RIGHT_CONTROL, "RightControl"},
    {GLFW_KEY_LEFT_ALT, "LeftAlt"},
    {GLFW_KEY_RIGHT_ALT, "RightAlt"},
});
constexpr auto kButtonNames = std::to_array<Named>({
    {GLFW_GAMEPAD_BUTTON_A, "A"},
    {GLFW_GAMEPAD_BUTTON_B, "B"},
    {GLFW_GAMEPAD_BUTTON_X, "X"},
    {GLFW_GAMEPAD_BUTTON_Y, "Y"},
    {GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, "LB"},
    {GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, "RB"},
    {GLFW_GAMEPAD_BUTTON_BACK, "Back"},
    {GLFW_GAMEPAD_BUTTON_START, "Start"},
    {GLFW_GAMEPAD_BUTTON_GUIDE, "Guide"},
    {GLFW_GAMEPAD_BUTTON_LEFT_THUMB, "LS"},
    {GLFW_GAMEPAD_BUTTON_RIGHT_THUMB, "RS"},
    {GLFW_GAMEPAD_BUTTON_DPAD_UP, "PadUp"},
    {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, "PadRight"},
    {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, "PadDown"},
    {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, "PadLeft"},
});
constexpr std::string_view kNone = "-", kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

template <class Names> std::optional<int> numberOf(const Names& names, std::string_view name) {
    if (name == kNone) return -1;
    const auto row = std::ranges::find(names, name, &Named::name);
    if (row != names.end()) return row->number;
    return std::nullopt;
}

std::optional<int> keyNamed(std::string_view name) {
    if (name.size() == 1 && kLetters.find(name[0]) != std::string_view::npos)
        return name[0]; // GLFW's numbers are the ASCII codes
    return numberOf(kKeyNames, name);
}

// Takes the word up to the separator off the text, with the separator.
std::string_view takeWord(std::string_view& text, char separator) {
    const size_t end = std::min(text.find(separator), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

} // namespace

std::string_view keyName(int key) {
    const size_t letter =
        key > 0 && key < 128 ? kLetters.find(static_cast<char>(key)) : std::string_view::npos;
    if (letter != std::string_view::npos) return kLetters.substr(letter, 1);
    const auto row = std::ranges::find(kKeyNames, key, &Named::number);
    return row != kKeyNames.end() ? row->name : kNone;
}

std::string_view buttonName(int button) {
    const auto row = std::ranges::find(kButtonNames, button, &Named::number);
    return row != kButtonNames.end() ? row->name : kNone;
}

Bindings::Bindings() {
    for (const ActionRow& row : kActionRows) bound_[static_cast<size_t>(row.action)] = {row.keys, row.button};
}

std::optional<Action> Bindings::bindKey(Action action, int key) {
    std::optional<Action> loser;
    for (size_t i = 0; i < kActions; ++i)
        for (int& bound : bound_[i].keys)
            if (bound == key) {
                bound = -1;
                if (i != static_cast<size_t>(action)) loser = static_cast<Action>(i);
            }
    bound_[static_cast<size_t>(action)].keys[0] = key;
    return loser;
}

std::optional<Action> Bindings::bindButton(Action action, int button) {
    std::optional<Action> loser;
    for (size_t i = 0; i < kActions; ++i)
        if (bound_[i].button == button && i != static_cast<size_t>(action)) {
            bound_[i].button = -1;
            loser = static_cast<Action>(i);
        }
    bound_[static_cast<size_t>(action)].button = button;
    return loser;
}

bool Bindings::parse(std::string_view text) {
    Bindings read = *this;
    while (!text.empty()) {
        std::string_view entry = takeWord(text, ';');
        while (entry.starts_with(' ')) entry.remove_prefix(1);
        if (entry.empty()) continue;
        const std::string_view name = takeWord(entry, '=');
        const auto row = std::ranges::find(kActionRows, name, &ActionRow::name);
        std::string_view keys = takeWord(entry, ' ');
        const auto first = keyNamed(takeWord(keys, ',')), second = keyNamed(keys.empty() ? kNone : keys);
        const auto button = numberOf(kButtonNames, entry.empty() ? kNone : entry);
        if (row == kActionRows.end() || !first || !second || !button) return false;
        read.bound_[static_cast<size_t>(row->action)] = {{*first, *second}, *button};
    }
    *this = read;
    return true;
}

std::string Bindings::toText() const {
    std::string text;
    for (const ActionRow& row : kActionRows) {
        const Keys& keys = of(row.action);
        if (keys.keys == row.keys && keys.button == row.button) continue; // defaults may change
        text += std::string(text.empty() ? "" : "; ") + row.name + "=" + std::string(keyName(keys.keys[0])) +
                "," + std::string(keyName(keys.keys[1])) + " " + std::string(buttonName(keys.button));
    }
    return text;
}

Controls readControls(const platform::Window& window, const platform::WindowInput& input,
                      const Bindings& bindings) {
    const platform::Gamepad& pad = input.gamepad;
    Controls controls;
    for (size_t i = 0; i < kActions; ++i) {
        const Bindings::Keys& bound = bindings.of(static_cast<Action>(i));
        for (const int key : bound.keys) {
            if (key < 0) continue;
            controls.pressed[i] =
                controls.pressed[i] || std::ranges::find(input.keysPressed, key) != input.keysPressed.end();
            controls.down[i] = controls.down[i] || window.down(key);
        }
        if (bound.button < 0) continue;
        controls.pressed[i] =
            controls.pressed[i] || std::ranges::find(pad.pressed, bound.button) != pad.pressed.end();
        controls.down[i] = controls.down[i] || pad.down[static_cast<size_t>(bound.button)];
    }
    // The middle button pauses too, for players without a keyboard at hand.
    constexpr auto kPause = static_cast<size_t>(Action::Pause);
    controls.pressed[kPause] = controls.pressed[kPause] || input.middlePressed;
    controls.cursor = input.cursor;
    controls.mouseMoved = input.cursorMoved != glm::dvec2(0);
    controls.turns = input.rightButton;
    if (input.rightButton) controls.dragged = input.cursorMoved;
    controls.wheel = input.wheel;
    controls.mouseCloses = input.leftButton;
    controls.look = pad.leftStick;
    controls.reach = pad.rightStick;
    controls.trigger = pad.present ? pad.rightTrigger : 0;
    return controls;
}

} // namespace shoal::app
