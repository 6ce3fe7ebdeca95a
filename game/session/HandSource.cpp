#include "game/session/HandSource.h"

#include "input/hands/HandSourceSelector.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::app {

namespace {

constexpr float kKeyTurn_radps = 1.6f;
constexpr float kDragTurn_rad = 0.0032f; // a pixel
constexpr float kPitchMax = 1.45f;

} // namespace

void MouseSource::frame(platform::Window* window, const platform::WindowInput* input,
                        const game::Snapshot& shown, float dt_s, float verticalFov, float aspect) {
    hands::MouseInput mouse;
    mouse.aspect = aspect;
    mouse.fovY = verticalFov;
    if (window && input) {
        const auto key = [&](int plus, int minus) {
            return static_cast<float>(window->down(plus)) - static_cast<float>(window->down(minus));
        };
        const float turn = kKeyTurn_radps * dt_s;
        yaw_ += turn * (key(GLFW_KEY_RIGHT, GLFW_KEY_LEFT) + key(GLFW_KEY_D, GLFW_KEY_A));
        pitch_ += turn * (key(GLFW_KEY_UP, GLFW_KEY_DOWN) + key(GLFW_KEY_W, GLFW_KEY_S));
        window->holdCursor(input->rightButton);
        if (input->rightButton) {
            yaw_ += static_cast<float>(input->cursorMoved.x) * kDragTurn_rad;
            pitch_ -= static_cast<float>(input->cursorMoved.y) * kDragTurn_rad;
        }
        pitch_ = std::clamp(pitch_, -kPitchMax, kPitchMax);
        yaw_ = std::remainder(yaw_, 2 * std::numbers::pi_v<float>);
        mouse.cursor = {static_cast<float>(input->cursor.x) * 2 - 1,
                        1 - static_cast<float>(input->cursor.y) * 2};
        mouse.wheel = static_cast<float>(input->wheel);
        mouse.close = input->leftButton || window->down(GLFW_KEY_SPACE);
        for (const int pressed : input->keysPressed) mouse.swapHands |= pressed == GLFW_KEY_TAB;
        used_ |= mouse.close;
        const float half = std::tan(verticalFov / 2);
        const glm::vec3 ray =
            glm::normalize(glm::vec3(mouse.cursor.x * half * aspect, mouse.cursor.y * half, -1));
        if (const float assist_m = game::reachAssist(shown, species_, ray); assist_m > 0)
            mouse.assist_m = assist_m;
    }
    poses_ = hands_.update(mouse, dt_s);
}

void MouseSource::next(game::TickInput& out) const {
    out = {};
    out.hands = poses_;
    out.worldFromView =
        glm::angleAxis(-yaw_, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch_, glm::vec3(1, 0, 0));
}

void OpenXrSource::next(game::TickInput& out, float share) const {
    out.hands = poses_;
    for (size_t side = 0; side < 2; ++side)
        if (before_[side].tracked && poses_[side].tracked)
            out.hands[side] = hands::between(before_[side], poses_[side], share);
}

} // namespace shoal::app
