#include "game/session/Controls.h"

#include <GLFW/glfw3.h>

namespace shoal::app {

const std::array<ActionRow, kActions> kActionRows = {{
    {"close", "Close the hand", {GLFW_KEY_SPACE, -1}, GLFW_GAMEPAD_BUTTON_A},
    {"look-left", "Look left", {GLFW_KEY_LEFT, GLFW_KEY_A}, -1},
    {"look-right", "Look right", {GLFW_KEY_RIGHT, GLFW_KEY_D}, -1},
    {"look-up", "Look up", {GLFW_KEY_UP, GLFW_KEY_W}, -1},
    {"look-down", "Look down", {GLFW_KEY_DOWN, GLFW_KEY_S}, -1},
    {"farther", "Reach farther", {GLFW_KEY_E, GLFW_KEY_PAGE_UP}, GLFW_GAMEPAD_BUTTON_DPAD_UP},
    {"nearer", "Reach nearer", {GLFW_KEY_C, GLFW_KEY_PAGE_DOWN}, GLFW_GAMEPAD_BUTTON_DPAD_DOWN},
    {"swap-hands", "Swap hands", {GLFW_KEY_TAB, -1}, GLFW_GAMEPAD_BUTTON_Y},
    {"recentre", "Recentre view", {GLFW_KEY_HOME, -1}, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB},
    {"pause", "Pause", {GLFW_KEY_ESCAPE, GLFW_KEY_P}, GLFW_GAMEPAD_BUTTON_START},
    {"louder", "Louder", {GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD}, -1},
    {"quieter", "Quieter", {GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT}, -1},
    {"fullscreen", "Fullscreen", {GLFW_KEY_F11, -1}, -1},
    {"performance", "Technical details", {GLFW_KEY_F1, -1}, -1},
    {"room", "Your own room", {GLFW_KEY_F2, -1}, -1},
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
    {GLFW_KEY_KP_ADD, "Keypad+"},
    {GLFW_KEY_KP_SUBTRACT, "Keypad-"},
    {GLFW_KEY_KP_ENTER, "KeypadEnter"},
    {GLFW_KEY_LEFT_SHIFT, "LeftShift"},
    {GLFW_KEY_RIGHT_SHIFT, "RightShift"},
    {GLFW_KEY_LEFT_CONTROL, "LeftControl"},
    {GLFW_KEY_RIGHT_CONTROL, "RightControl"},
    {GLFW_KEY_LEFT_ALT, "LeftAlt"},
    {GLFW_KEY_RIGHT_ALT, "RightAlt"},
});
struct Numbered {
    std::string_view prefix;
    int firstKey, first, last; // numbers
};
constexpr auto kNumberedKeys =
    std::to_array<Numbered>({{"F", GLFW_KEY_F1, 1, 12}, {"Keypad", GLFW_KEY_KP_0, 0, 9}});
constexpr std::array<std::string_view, GLFW_GAMEPAD_BUTTON_LAST + 1> kButtonNames = {
    "A",     "B",  "X",  "Y",     "LB",       "RB",      "Back",   "Start",
    "Guide", "LS", "RS", "PadUp", "PadRight", "PadDown", "PadLeft"};
constexpr std::string_view kNone = "-", kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

// Returns the first number from -1, none, to `last` that has this name.
template <class NameOf> std::optional<int> numberNamed(std::string_view name, NameOf&& nameOf, int last) {
    for (int number = -1; number <= last; ++number)
        if (nameOf(number) == name) return number;
    return std::nullopt;
}

// Takes the word up to the separator off the text, with the separator.
std::string_view takeWord(std::string_view& text, char separator) {
    const size_t end = std::min(text.find(separator), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

} // namespace

std::string keyName(int key) {
    if (key > 0 && key < 128 && kLetters.find(static_cast<char>(key)) != std::string_view::npos)
        return {static_cast<char>(key)}; // GLFW's numbers are the ASCII codes
    for (const Numbered& row : kNumberedKeys)
        if (const int number = key - row.firstKey + row.first; number >= row.first && number <= row.last)
            return std::string(row.prefix) + std::to_string(number);
    const auto row = std::ranges::find(kKeyNames, key, &Named::number);
    return std::string(row != kKeyNames.end() ? row->name : kNone);
}

std::string_view buttonName(int button) {
    return button >= 0 && button <= GLFW_GAMEPAD_BUTTON_LAST ? kButtonNames[button] : kNone;
}

std::optional<Action> Bindings::bind(Action action, int number, bool isButton) {
    std::optional<Action> loser;
    for (size_t i = 0; i < kActions; ++i) {
        auto& [keys, button] = bound_[i];
        for (int* bound : {&keys[0], &keys[1], &button}) {
            if ((bound == &button) != isButton || *bound != number) continue;
            *bound = -1;
            if (i != static_cast<size_t>(action)) loser = static_cast<Action>(i);
        }
    }
    Keys& own = bound_[static_cast<size_t>(action)];
    (isButton ? own.button : own.keys[0]) = number;
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
        const auto keyNamed = [](std::string_view key) { return numberNamed(key, keyName, GLFW_KEY_LAST); };
        const auto first = keyNamed(takeWord(keys, ',')), second = keyNamed(keys.empty() ? kNone : keys);
        const auto button = numberNamed(entry.empty() ? kNone : entry, buttonName, GLFW_GAMEPAD_BUTTON_LAST);
        if (row == kActionRows.end() || !first || !second || !button) return false;
        read.bound_[static_cast<size_t>(row - kActionRows.begin())] = {{*first, *second}, *button};
    }
    *this = read;
    return true;
}

std::string Bindings::toText() const {
    std::string text;
    for (size_t i = 0; i < kActions; ++i) {
        const ActionRow& row = kActionRows[i];
        const Keys& keys = bound_[i];
        if (keys.keys == row.keys && keys.button == row.button) continue; // defaults may change
        text += std::string(text.empty() ? "" : "; ") + row.name + "=" + keyName(keys.keys[0]) + "," +
                keyName(keys.keys[1]) + " " + std::string(buttonName(keys.button));
    }
    return text;
}

Controls readControls(platform::Window& window, const Bindings& bindings) {
    Controls controls{.input = window.poll(), .down = {}, .pressed = {}};
    const platform::WindowInput& input = controls.input;
    const platform::Gamepad& pad = input.gamepad;
    for (size_t i = 0; i < kActions; ++i) {
        const auto& [keys, button] = bindings.of(static_cast<Action>(i));
        // The middle button pauses too, for players without a keyboard at hand.
        bool pressed = static_cast<Action>(i) == Action::Pause && input.middlePressed, down = false;
        for (const int key : keys) {
            pressed |= key >= 0 && std::ranges::count(input.keysPressed, key) > 0;
            down |= key >= 0 && window.down(key);
        }
        controls.pressed[i] = pressed || (button >= 0 && std::ranges::count(pad.pressed, button) > 0);
        controls.down[i] = down || (button >= 0 && pad.down[button]);
    }
    return controls;
}

} // namespace shoal::app
