#include "game/session/HandSource.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace shoal::app {

namespace {

constexpr float kKeyTurn_radps = 1.6f;
constexpr float kDragTurn_rad = 0.0032f; // a pixel
constexpr float kPitchMax = 1.45f;

constexpr double kCaption_s = 4;
constexpr double kFindDevices_s = 1; // before the mouse is said to be all there is

// No text: the first camera.
hands::WebcamOptions webcamFrom(const std::string& which, bool live) {
    const bool isIndex = which.size() <= 2 && which.find_first_not_of("0123456789") == std::string::npos;
    return isIndex ? hands::WebcamOptions{"", std::atoi(which.c_str()), live}
                   : hands::WebcamOptions{which, 0, live};
}

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
        mouse.reach_m = reach_.update(shown, species_, ray, hands_.distance_m());
        mouse.reachHelp = reachHelp_;
    }
    poses_ = hands_.update(mouse, dt_s);
}

void MouseSource::next(game::TickInput& out) const {
    out = {};
    out.hands = poses_;
    out.worldFromView =
        glm::angleAxis(-yaw_, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch_, glm::vec3(1, 0, 0));
}

TrackedHands::TrackedHands(const HandSourceChoice& source, const HandOptions& options,
                           const hands::HandRig& rig, bool live)
    : asked_(source.kind != HandSourceKind::Auto),
      tracker_(source.kind == HandSourceKind::Webcam
                   ? hands::makeWebcamTracker(webcamFrom(source.argument, live), rig)
                   : hands::makeLeapTracker(options.leap, rig)),
      hands_(live ? hands::DeviceTime::Live : hands::DeviceTime::Stamps) {}

void TrackedHands::announce() {
    announced_ = state_.present;
    announcedAt_s_ = played_s_;
    const std::string name(tracker_->name());
    announcement_ = "Hands: mouse";
    if (state_.present)
        announcement_ = "Hands: " + name + ", " + state_.description;
    else if (asked_) // why not this one
        announcement_ += "; " + name + ": " + state_.description;
    log::info("{}", announcement_);
}

void TrackedHands::frame(double elapsed_s) {
    hands::HandStream& stream = tracker_->stream();
    hands_.advance(stream, elapsed_s);
    played_s_ += elapsed_s;
    state_ = stream.state();
    if (announced_ != state_.present && (state_.present || played_s_ > kFindDevices_s)) announce();
}

void TrackedHands::tick(game::TickInput& input, int ticksLeft) {
    choice_.tick(hands_, input.hands, ticksLeft, static_cast<float>(sim::kTick_s));
}

std::string_view TrackedHands::caption() const {
    if (!state_.instruction.empty()) return state_.instruction;
    return played_s_ - announcedAt_s_ < kCaption_s ? std::string_view(announcement_) : std::string_view();
}

Status checkHandSource(const HandSourceChoice& source) {
    const bool isClip =
        source.kind == HandSourceKind::Webcam && !webcamFrom(source.argument, false).file.empty();
    std::error_code code;
    if (!isClip || std::filesystem::is_regular_file(source.argument, code)) return Done{};
    return Error{source.argument, "there is no such clip"};
}

void OpenXrSource::next(game::TickInput& out, float share) const {
    out.hands = poses_;
    for (size_t side = 0; side < 2; ++side)
        if (before_[side].tracked && poses_[side].tracked)
            out.hands[side] = hands::between(before_[side], poses_[side], share);
}

} // namespace shoal::app
