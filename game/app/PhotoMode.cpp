#include "game/app/PhotoMode.h"

#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/math/LatLong.h"
#include "engine/media/Pictures.h"
#include "game/views/SceneRenderer.h"

#include <GLFW/glfw3.h>
#include <fmt/chrono.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <ctime>
#include <numbers>

namespace shoal::app {

constexpr float kTurn_radps = 1.2f, kMove_mps = 0.8f;
constexpr float kFarthest_m = 0.5f; // from the player: beyond, the film has holes

// Returns the rotations of the six faces of a cube, each of 90 degrees: ahead, right, back, left, up, down.
static std::array<glm::quat, 6> faceTurns() {
    constexpr float kQuarter = std::numbers::pi_v<float> / 2;
    const auto about = [](glm::vec3 axis, float angle) { return glm::angleAxis(angle, axis); };
    return {about({0, 1, 0}, 0),        about({0, 1, 0}, -kQuarter), about({0, 1, 0}, 2 * kQuarter),
            about({0, 1, 0}, kQuarter), about({1, 0, 0}, kQuarter),  about({1, 0, 0}, -kQuarter)};
}

static size_t faceOf(glm::vec3 d) {
    const glm::vec3 a = glm::abs(d);
    if (a.y >= a.x && a.y >= a.z) return d.y > 0 ? 4 : 5;
    if (a.x >= a.z) return d.x > 0 ? 1 : 3;
    return d.z < 0 ? 0 : 2;
}

// Returns the name of a new file in the folder for pictures, by date and time: shoal-2026-11-22-213045.png.
// what: "-360" or nothing.
static Path newPictureFile(std::string_view what) {
    return userFolder(UserFolder::Pictures) /
           fmt::format("shoal-{:%Y-%m-%d-%H%M%S}{}.png", fmt::localtime(std::time(nullptr)), what);
}

// Returns the names of the actions' keys: of each its second key if that is a single letter, else its first.
static std::string keysOf(std::initializer_list<Action> actions, const Bindings& bindings) {
    std::string names;
    for (const Action action : actions) {
        const auto& keys = bindings.of(action).keys;
        const std::string first = keyName(keys[0]), second = keyName(keys[1]);
        names += (names.empty() ? "" : " ") + (second.size() == 1 && keys[1] >= 0 ? second : first);
    }
    return names;
}

// Draws the scene in all directions as a lat-long picture, twice as wide as high.
static Result<ImageRgb8> drawAround(SceneRenderer& renderer, glm::vec3 eyeWorld, int width) {
    const int edge = width / 4;
    const std::array<glm::quat, 6> turns = faceTurns();
    std::array<ImageRgba8, 6> faces;
    for (size_t face = 0; face < faces.size(); ++face) {
        const gl::Target target(edge, edge, gl::defaultSamples());
        const render::View view{.eyeWorld = eyeWorld,
                                .worldFromEye = turns[face],
                                .verticalFov = std::numbers::pi_v<float> / 2,
                                .aspect = 1,
                                .heightPixels = edge};
        const SceneRenderer::Eye eye{0, view, target};
        if (Status drawn = renderer.draw({&eye, 1}); !drawn) return drawn.error();
        faces[face] = target.read();
    }
    ImageRgb8 around(width, width / 2);
    for (int y = 0; y < around.height; ++y)
        for (int x = 0; x < around.width; ++x) {
            const glm::vec3 d = texelDirection(x, y, width, around.height);
            const size_t face = faceOf(d);
            const glm::vec3 inFace = glm::conjugate(turns[face]) * d;
            const glm::vec2 at =
                (glm::vec2(inFace.x, -inFace.y) / -inFace.z * 0.5f + 0.5f) * static_cast<float>(edge) - 0.5f;
            const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor(at)), 0, edge - 2);
            const glm::vec2 share = glm::clamp(at - glm::vec2(low), 0.0f, 1.0f);
            const auto row = [&](int dy) {
                const uint8_t* texels = faces[face].at(low.x, low.y + dy); // two of 4 bytes
                return glm::mix(glm::vec3(texels[0], texels[1], texels[2]),
                                glm::vec3(texels[4], texels[5], texels[6]), share.x);
            };
            const glm::vec3 mixed = glm::mix(row(0), row(1), share.y) + 0.5f;
            for (int c = 0; c < 3; ++c) around.at(x, y)[c] = static_cast<uint8_t>(mixed[c]);
        }
    return around;
}

PhotoMode::PhotoMode(const game::Snapshot& from, float fov_deg, bool byGamepad, const Bindings& bindings)
    : shown(from), player{from.headWorld, from.worldFromView}, fovBefore_deg(fov_deg),
      notice(
          byGamepad
              ? game::Notice{"A: take a picture. Left stick: look. Right stick: move. Y: hands. B: back"}
              : game::Notice{"Click: take a picture. Right button: look. {}: move. Wheel: zoom. {}: hands. "
                             "Esc: back",
                             keysOf({Action::LookUp, Action::LookLeft, Action::LookDown, Action::LookRight,
                                     Action::Farther, Action::Nearer},
                                    bindings),
                             keysOf({Action::SwapHands}, bindings)}),
      hands_{from.hands[0].visible, from.hands[1].visible}, look_(LookAngles::of(from.worldFromView)) {
    for (game::HandView& hand : shown.hands) hand.visible = false, hand.ready = 0;
    for (game::CreatureView& creature : shown.creatures) creature.catchable = 0; // no highlight either
}

PhotoMode::Command PhotoMode::step(const Controls& c, float sensitivity, float dt_s, float& fov_deg) {
    const glm::vec2 drag = glm::vec2(c.dragged().x, -c.dragged().y) * (kDragTurn_rad * sensitivity);
    look_.turnBy(c.input.gamepad.leftStick * (kTurn_radps * dt_s) + drag);
    shown.worldFromView = look_.worldFromView();
    const glm::vec3 way(c.axis(Action::LookRight, Action::LookLeft) + c.input.gamepad.rightStick.x,
                        c.axis(Action::Farther, Action::Nearer),
                        c.axis(Action::LookDown, Action::LookUp) - c.input.gamepad.rightStick.y);
    glm::vec3 from = shown.headWorld + shown.worldFromView * way * (kMove_mps * dt_s) - player.positionWorld;
    if (const float length = glm::length(from); length > kFarthest_m) from *= kFarthest_m / length;
    shown.headWorld = player.positionWorld + from;
    if (c.wasPressed(Action::SwapHands))
        for (size_t side = 0; side < hands_.size(); ++side)
            shown.hands[side].visible = hands_[side] && !shown.hands[side].visible;
    fov_deg = std::clamp(fov_deg - 4 * static_cast<float>(c.input.wheel), 20.0f, 130.0f);
    const platform::WindowInput& input = c.input;
    if (c.wasPressed(Action::Pause) || std::ranges::count(input.gamepad.pressed, GLFW_GAMEPAD_BUTTON_B) > 0)
        return Command::Leave;
    const bool takes = input.leftPressed || c.wasPressed(Action::CloseHand) ||
                       std::ranges::count(input.keysPressed, GLFW_KEY_ENTER) > 0;
    return takes ? Command::Picture : Command::None;
}

void PhotoMode::save(const ImageRgb8& picture, SceneRenderer& renderer) {
    constexpr int kAroundWidth = 4096;
    const Path file = newPictureFile(""), around = newPictureFile("-360");
    const Status flat = media::writePng(file, picture);
    Status saved = flat;
    if (flat) {
        const auto drawn = drawAround(renderer, shown.headWorld, kAroundWidth);
        saved = drawn ? media::writePng(around, *drawn) : Status(drawn.error());
    }
    notice = saved  ? game::Notice{"Saved, together with a 360-degree picture: {}", file.string()}
             : flat ? game::Notice{"Saved without its 360-degree picture: {}", saved.error().message()}
                    : game::Notice{"Not saved: {}", saved.error().message()};
    log::info("{}", notice->in(game::Language::English));
}

} // namespace shoal::app
