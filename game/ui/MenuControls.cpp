#include "game/ui/MenuControls.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace shoal::app {

namespace {

constexpr float kRepeatFirst_s = 0.4f, kRepeat_s = 0.09f;
constexpr float kStick = 0.6f; // share of the stick's range that counts as a step

struct DirectionKey {
    int key, button;
    glm::ivec2 direction;
};
constexpr std::array kDirectionKeys = std::to_array<DirectionKey>({
    {GLFW_KEY_UP, GLFW_GAMEPAD_BUTTON_DPAD_UP, {0, -1}},
    {GLFW_KEY_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, {0, 1}},
    {GLFW_KEY_LEFT, GLFW_GAMEPAD_BUTTON_DPAD_LEFT, {-1, 0}},
    {GLFW_KEY_RIGHT, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, {1, 0}},
});

int stepOf(float stick) { return stick > kStick ? 1 : stick < -kStick ? -1 : 0; }

bool has(const std::vector<int>& list, int value) { return std::ranges::find(list, value) != list.end(); }

} // namespace

Pointing pointingInView(const hands::HandPose& hand, glm::vec2 tanHalf) {
    const glm::vec3 tip = hand.joints[hands::kFingerJoints[1].tip].position;
    const float depth_m = -tip.z;
    if (!hand.tracked || depth_m < 0.05f) return {};
    return {true,
            {0.5f + 0.5f * tip.x / (depth_m * tanHalf.x), 0.5f - 0.5f * tip.y / (depth_m * tanHalf.y)},
            depth_m};
}

void FingerPoke::step(const Pointing& finger, float dt_s) {
    pressed = false;
    if (!finger.points) {
        pointing = held = false;
        return;
    }
    if (!pointing) mean_m_ = finger.forward_m;
    pointing = true;
    const float forward_m = finger.forward_m - mean_m_;
    // A press counts where the finger pointed before it moved, as a poking finger does not move straight.
    if (forward_m < kRelease_m || finger.pulls) steady_ = finger.at;
    if (!held) at = finger.at;
    if (!held && (forward_m > kPress_m || (finger.pulls && !pulled_))) {
        pressed = held = true;
        at = steady_;
    }
    if (held && forward_m < kRelease_m && !finger.pulls) held = false;
    pulled_ = finger.pulls;
    mean_m_ += forward_m * std::min(1.0f, dt_s / kMean_s);
}

MenuInput MenuControls::step(const platform::WindowInput& input, const platform::Window* window,
                             const std::array<Pointing, 2>& fingers, const MenuSurface& surface, float dt_s) {
    MenuInput menu;
    const platform::Gamepad& pad = input.gamepad;
    glm::ivec2 held(stepOf(pad.leftStick.x), -stepOf(pad.leftStick.y)), steps(0);
    for (const DirectionKey& key : kDirectionKeys) {
        steps += key.direction * static_cast<int>(std::ranges::count(input.keysPressed, key.key));
        if (has(pad.pressed, key.button)) steps += key.direction;
        if ((window && window->down(key.key)) || pad.down[static_cast<size_t>(key.button)])
            held += key.direction;
    }
    held = glm::clamp(held, -1, 1);
    if (held != held_) {
        repeat_s_ = kRepeatFirst_s;
        if (steps == glm::ivec2(0) && held_ == glm::ivec2(0)) steps = held; // the stick's first step
    } else if (held != glm::ivec2(0) && (repeat_s_ -= dt_s) <= 0) {
        repeat_s_ = kRepeat_s;
        steps += held;
    }
    held_ = held;
    menu.down = steps.y;
    menu.right = steps.x;
    menu.accept = has(input.keysPressed, GLFW_KEY_ENTER) || has(input.keysPressed, GLFW_KEY_KP_ENTER) ||
                  has(input.keysPressed, GLFW_KEY_SPACE) || has(pad.pressed, GLFW_GAMEPAD_BUTTON_A);
    menu.back = has(input.keysPressed, GLFW_KEY_ESCAPE) || input.middlePressed ||
                has(pad.pressed, GLFW_GAMEPAD_BUTTON_B);
    if (surface.mouse) {
        if (input.cursorMoved != glm::dvec2(0) || input.leftPressed || input.leftButton) {
            const float across = static_cast<float>(input.cursor.x) * static_cast<float>(surface.eyes);
            menu.pointer = glm::vec2(std::fmod(across, 1.0f), input.cursor.y) * surface.size;
        }
        menu.pressed = input.leftPressed;
        menu.held = input.leftButton;
    }
    menu.wheel = static_cast<float>(input.wheel);
    const bool other = menu.down != 0 || menu.right != 0 || menu.accept || menu.back || menu.pointer;
    fingersRest_s_ = other ? kFingersRest_s : std::max(fingersRest_s_ - dt_s, 0.0f);
    finger_.reset();
    for (size_t i = 0; i < fingers.size(); ++i) {
        pokes_[i].step(fingers[i], dt_s);
        if (!pokes_[i].pointing || fingersRest_s_ > 0) continue;
        finger_ = menu.pointer = pokes_[i].at * surface.size;
        menu.pressed |= pokes_[i].pressed;
        menu.held |= pokes_[i].held;
    }
    return menu;
}

} // namespace shoal::app
