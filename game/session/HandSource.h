// Sources of a session's input: mouse and keys, with or without a tracking device beside, a headset, a
// playthrough script, or a replay. Main thread.
#pragma once

#include "engine/core/Result.h"
#include "engine/platform/Window.h"
#include "engine/sim/Recording.h"
#include "game/playthrough/Script.h"
#include "game/rules/Dive.h"
#include "game/rules/ReachHelp.h"
#include "game/session/Controls.h"
#include "game/session/LookAngles.h"
#include "game/settings/PlayOptions.h"
#include "input/hands/HandSourceSelector.h"
#include "input/hands/MouseHands.h"

#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace shoal::app {

// Mouse and keys. Poses change once a frame and are the same for all its ticks.
class MouseSource {
  public:
    MouseSource(hands::HandRig rig, game::SpeciesTable species)
        : hands_(std::move(rig)), species_(std::move(species)) {}

    // controls: null when headless, where the hands rest and the head looks ahead.
    void frame(const Controls* controls, const ControlOptions& options, const game::Snapshot& shown,
               float dt_s, float verticalFov, float aspect);
    // Nobody plays: no hands are seen, and the head turns by itself. yaw: radians a second, to the right.
    void idle(float dt_s, float yaw_radps);
    // The player is in a menu: hands and view stay, and the press that ends the menu closes no hand.
    void release() { awaitsOpen_ = true; }
    void next(game::TickInput& out) const;
    void recentre() { look_ = {}; }
    // The view turns by the player's will, radians a second; smoothed, for the dark edges that help comfort.
    float turning_radps() const { return turning_radps_; }

  private:
    hands::MouseHands hands_;
    game::SpeciesTable species_;
    game::ReachHelp reach_;
    std::array<hands::HandPose, 2> poses_{};
    LookAngles look_;
    float turning_radps_ = 0;
    glm::vec2 pointer_{0}; // what the hand reaches for: -1 to 1 across the window, +x right, +y up
    Handedness hand_ = Handedness::Right; // as the player has chosen
    bool wasDown_ = false;
    bool toggled_ = false;   // closed, where each press closes or opens
    bool awaitsOpen_ = true; // the press that ended a menu closes no hand
    bool snapped_ = false;   // the stick has turned the view by a step, and has not come back yet
};

// The inputs of a recording, whose states it compares with those that follow from them now.
struct ReplaySource {
    explicit ReplaySource(sim::RecordingReader from) : recording(std::move(from)) {}

    // False: there is no further input.
    bool next(game::TickInput& input);
    void compare(uint64_t stateHash); // of the state after that input
    bool atEnd() const { return !verdict || recording.atEnd(); }

    sim::RecordingReader recording;
    uint64_t hash = 0;       // recorded, of the state after the last input
    Status verdict = Done{}; // so far
};

// The hand tracking device of a session, which has threads of its own; where it sees no hands, the mouse has
// them.
class TrackedHands {
  public:
    // live: time is the clock's; else frames count by their time stamps. source: Leap, Webcam, or Auto, which
    // never means a camera: that looks at people and is opened only when it is asked for.
    TrackedHands(const HandSourceChoice& source, const HandOptions& options, const hands::HandRig& rig,
                 bool live);

    // Once a frame of the display.
    void frame(double elapsed_s);

    // Once a tick, which lies so long before the frame's time: replaces the mouse's hands in `input` by those
    // of the device, if one sees hands.
    void tick(game::TickInput& input, float ago_s);

    // Arms follow the elbows that the device sees. Not recorded: the picture alone has them.
    void showElbows(game::Snapshot& shown) const;

    // Of the hands that the device sees now, viewer's frame; the others are not tracked.
    std::array<hands::HandPose, 2> seen() const;

    // What its camera sees: true where there is a picture newer than `out`, which it replaces. Is to be
    // called once a frame while the picture is shown.
    bool look(ImageRgba8& out);
    bool hasCamera() const { return tracker_->preview() != nullptr; }

    // Of the only hand that is seen, if that is open: from the camera to its palm, if it were of the rig's
    // size, metres.
    std::optional<float> openHand_m() const;
    void setHandSize(float size) { tracker_->setHandSize(size); }

    // The player's next step, without which the device finds no hands; empty: there is none.
    std::optional<game::Notice> needs() const;
    // To be shown now: which device is used, or why not. Null: nothing.
    const game::Notice* notice() const;

  private:
    void announce();

    bool asked_; // for this device, not for whichever is there
    std::unique_ptr<hands::HandTracker> tracker_;
    hands::DeviceHands hands_;
    hands::DeviceState state_;
    hands::HandSourceSelector choice_;        // between its hands and the mouse's
    std::optional<bool> announced_;           // that it is there, or that it is not
    std::array<glm::vec3, 2> towardsElbow_{}; // viewer's frame, eased to and from 0
    std::optional<game::Notice> announcement_;
    double played_s_ = 0, announcedAt_s_ = 0;
};

// Fails where the source is a clip that is not there.
Status checkHandSource(const HandSourceChoice& source);

// Hands that a headset tracks, predicted for the display time of its next frame; see HeadsetDisplay.
class OpenXrSource {
  public:
    void frame(const std::array<hands::HandPose, 2>& poses) { before_ = std::exchange(poses_, poses); }
    // share: the tick's time between the frame before (0) and this one (1).
    void next(game::TickInput& out, float share) const;

  private:
    std::array<hands::HandPose, 2> before_{}, poses_{};
};

using HandSource = std::variant<MouseSource, game::ScriptRun, ReplaySource, OpenXrSource>;

// A person plays, who may pause, start again and have a score.
inline bool playedByAPerson(const HandSource& source) {
    return std::holds_alternative<MouseSource>(source) || std::holds_alternative<OpenXrSource>(source);
}

} // namespace shoal::app
