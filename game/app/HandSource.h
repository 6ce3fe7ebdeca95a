// Where the player's input comes from: mouse and keys, a headset, a playthrough script, or a replay.
#pragma once

#include "engine/core/Result.h"
#include "engine/platform/Window.h"
#include "engine/sim/Recording.h"
#include "engine/xr/Tracked.h"
#include "game/Dive.h"
#include "game/Script.h"
#include "input/hands/MouseHands.h"

#include <memory>
#include <optional>
#include <variant>

namespace shoal::app {

// Looks and reaches with mouse and keys. Poses change once a frame; every tick of the frame sees the same.
class MouseSource {
  public:
    MouseSource(hands::HandRig rig, game::SpeciesTable species);

    // window: null when headless, where the hands rest and the head looks ahead.
    void frame(platform::Window* window, const platform::WindowInput* input, const game::Snapshot& shown,
               float dt_s, float verticalFov, float aspect);
    void next(game::TickInput& out) const;
    bool used() const { return used_; } // the button has been held at least once

  private:
    hands::MouseHands hands_;
    game::SpeciesTable species_;
    std::array<hands::HandPose, 2> poses_{};
    float yaw_ = 0, pitch_ = 0; // radians; yaw to the right, pitch up
    bool used_ = false;
};

struct ReplaySource {
    sim::Recording recording;
    size_t tick = 0;
};

// Hands as a headset sees them, for the time when its next frame will be seen; see XrPlay.
class OpenXrSource {
  public:
    void frame(const std::array<hands::HandPose, 2>& poses);
    // share: of the way from the frame before to this one, where the tick lies.
    void next(game::TickInput& out, float share) const;

  private:
    std::array<hands::HandPose, 2> before_{}, poses_{};
};

using HandSource = std::variant<MouseSource, game::ScriptRun, ReplaySource, OpenXrSource>;

// Whether somebody plays, who may pause, start again and have a score.
inline bool playedByAPerson(const HandSource& source) {
    return std::holds_alternative<MouseSource>(source) || std::holds_alternative<OpenXrSource>(source);
}

} // namespace shoal::app
