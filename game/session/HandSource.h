// Sources of a session's input: mouse and keys, with or without a hand tracking device; a headset; a
// playthrough script; a replay. Main thread.
#pragma once

#include "engine/sim/FixedStep.h"
#include "engine/sim/Recording.h"
#include "game/playthrough/Script.h"
#include "game/rules/Dive.h"
#include "game/session/Controls.h"
#include "game/settings/PlayOptions.h"
#include "input/hands/HandSourceSelector.h"
#include "input/hands/MouseHands.h"

#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace shoal::app {

// Returns the options' hand source, with defaults that depend on other options. Fails for a missing clip.
Result<HandSourceChoice> handSourceFor(const PlayOptions& options);

// Input by mouse, keys and gamepad. Poses change once a frame and are the same for all its ticks.
class MouseSource {
  public:
    MouseSource(hands::HandRig rig, game::SpeciesTable species)
        : hands_(std::move(rig)), species_(std::move(species)) {}

    // Reads a frame's input. controls: null when headless, where the hands rest and the head looks ahead.
    void frame(const Controls* controls, const ControlOptions& options, const game::Snapshot& shown,
               float dt_s, float verticalFov, float aspect);
    // Hides the hands and turns the head by itself, while nobody plays. yaw: radians a second, to the right.
    void idle(float dt_s, float yaw_radps) {
        look_.turnBy({yaw_radps * dt_s, 0});
        poses_ = {};
    }
    // Keeps hands and view as they are while a menu is open; the press that ends the menu closes no hand.
    void release() { awaitsOpen_ = true; }
    void next(game::TickInput& out) const {
        out.hands = poses_;
        out.worldFromView = look_.worldFromView();
    }
    // Shows the hand that the mouse does not move only while it holds something. Otherwise the hand sinks out
    // of the picture, so that hand and arm hide nothing. Only the picture changes, not the game's state.
    void show(game::Snapshot& shown) const;
    void recentre() { look_ = {}; }
    // Speed at which the player turns the view, radians a second, smoothed: for the comfort setting vignette.
    float turning_radps() const { return turning_radps_; }

  private:
    hands::MouseHands hands_;
    game::SpeciesTable species_;
    int reachTarget_ = -1; // see reachHelp()
    std::array<hands::HandPose, 2> poses_{};
    std::array<float, 2> sunk_{1, 1}; // by hand, 0 to 1: how far it has sunk
    LookAngles look_;
    float turning_radps_ = 0;
    glm::vec2 pointer_{0}; // position that the hand reaches for: -1 to 1 across the window, +x right, +y up
    hands::Side hand_ = hands::Side::Right; // the player's chosen hand
    bool wasDown_ = false;
    bool toggled_ = false;   // the hand is closed; used with Closing::Toggle
    bool awaitsOpen_ = true; // true until the press that ended a menu is released
    bool snapped_ = false;   // the stick has turned the view by a step and has not come back yet
};

// Plays the inputs of a recording, and compares its states with those that the inputs lead to now.
struct ReplaySource {
    // Reads the next input; false: there is none.
    bool next(game::TickInput& input);
    void compare(uint64_t stateHash); // compares the state after that input
    bool atEnd() const { return !verdict || recording.atEnd(); }

    sim::RecordingReader recording;
    uint64_t hash = 0;       // recorded hash of the state after the last input
    Status verdict = Done{}; // an error if a state differed or the file is damaged
};

// A session's hand tracking device, on threads of its own. While it sees no hands, the mouse moves them.
class TrackedHands {
  public:
    // live: runs in real time, else by the frames' time stamps. source: Leap, Webcam, or Auto, which never
    // opens a webcam, because a camera films people: the player must choose it.
    TrackedHands(const HandSourceChoice& source, const HandOptions& options, const hands::HandRig& rig,
                 bool live);

    // Takes the device's new frames, once a frame of the display.
    void frame(double elapsed_s);

    // Replaces the mouse's hands in `input` by those of the device, if it sees hands; call it once a tick.
    // ago_s: time from the tick to the frame.
    void tick(game::TickInput& input, float ago_s) { choice_.tick(hands_, input.hands, ago_s, sim::kTick_s); }

    // Sets the elbow directions that the device sees. Only drawn arms use them, so they are not recorded.
    void showElbows(game::Snapshot& shown) const {
        for (size_t side = 0; side < 2; ++side)
            shown.hands[side].towardsElbow = shown.worldFromView * towardsElbow_[side];
    }

    bool moveHands() const { return choice_.fromDevice(); } // else the mouse does

    // Returns the hands that the device sees now, viewer's frame; the others are not tracked.
    std::array<hands::HandPose, 2> seen() const {
        std::array<hands::HandPose, 2> poses{};
        for (int side = 0; side < 2; ++side)
            if (hands_.notSeen_s(side) <= hands::kHandLost_s) poses[side] = hands_.hand(side).pose();
        return poses;
    }

    // Replaces `out` if the device's camera has a newer picture, and returns whether it has. To be called
    // once a frame while the picture is shown.
    bool look(ImageRgba8& out) { return hasCamera() && tracker_->preview()->look(out); }
    bool hasCamera() const { return tracker_->preview() != nullptr; }

    // Returns the distance in metres from the camera to the palm if exactly one hand is seen and it is open,
    // estimated as for a hand of the rig's size.
    std::optional<float> openHand_m() const;
    void setHandSize(float size) { tracker_->setHandSize(size); }

    // Returns the instruction that the player must follow before the device can find hands; empty: none.
    std::optional<game::Notice> needs() const {
        if (!state_.lacksModels) return std::nullopt;
        return game::Notice{"Before the webcam can find your hands, run this once: {}",
                            hands::handModelScript().string()};
    }
    // Returns the message to show now: the device in use, or why it is not. Null: none.
    const game::Notice* notice() const {
        constexpr double kShown_s = 4;
        return announcement_ && played_s_ - announcedAt_s_ < kShown_s ? &*announcement_ : nullptr;
    }

  private:
    void announce();

    bool asked_; // the player has chosen this device, not Auto
    std::unique_ptr<hands::HandTracker> tracker_;
    hands::DeviceHands hands_;
    hands::DeviceState state_;
    hands::HandSourceSelector choice_;        // chooses between its hands and the mouse's
    std::optional<bool> announced_;           // whether the last announcement said that the device is there
    std::array<glm::vec3, 2> towardsElbow_{}; // viewer's frame, eased to and from 0
    std::optional<game::Notice> announcement_;
    double played_s_ = 0, announcedAt_s_ = 0;
};

// Hands that a headset tracks, predicted for the display time of its next frame; see HeadsetDisplay.
class OpenXrSource {
  public:
    void frame(const std::array<hands::HandPose, 2>& poses) { before_ = std::exchange(poses_, poses); }
    // share: fraction of the time from the last frame (0) to this one (1) at which the tick lies.
    void next(game::TickInput& out, float share) const {
        out.hands = poses_;
        for (size_t side = 0; side < 2; ++side)
            if (before_[side].tracked && poses_[side].tracked)
                out.hands[side] = hands::between(before_[side], poses_[side], share);
    }

  private:
    std::array<hands::HandPose, 2> before_{}, poses_{};
};

using HandSource = std::variant<MouseSource, game::ScriptRun, ReplaySource, OpenXrSource>;

// Returns whether a person plays, who may pause, start again and have a score.
inline bool playedByAPerson(const HandSource& source) {
    return std::holds_alternative<MouseSource>(source) || std::holds_alternative<OpenXrSource>(source);
}

} // namespace shoal::app
