// One run of the simulation with its source of input and its recording. Main thread.
#pragma once

#include "engine/media/live/LivePlayer.h"
#include "engine/sim/FixedStep.h"
#include "engine/sim/Recording.h"
#include "engine/xr/Tracked.h"
#include "game/playthrough/Script.h"
#include "game/rules/Dive.h"
#include "game/session/Controls.h"
#include "game/settings/PlayOptions.h"
#include "input/hands/HandSourceSelector.h"
#include "input/hands/MouseHands.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace shoal::app {

// Sources of a session's input: mouse and keys, with or without a tracking device; a headset; a playthrough
// script; a replay.

// Returns the options' hand source, with the defaults that depend on other options. Fails if it is a clip
// that does not exist.
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
    void recentre() { look_ = {}; }
    // Speed at which the player turns the view, radians a second, smoothed: for the comfort setting vignette.
    float turning_radps() const { return turning_radps_; }

  private:
    hands::MouseHands hands_;
    game::SpeciesTable species_;
    int reachTarget_ = -1; // see reachHelp()
    std::array<hands::HandPose, 2> poses_{};
    LookAngles look_;
    float turning_radps_ = 0;
    glm::vec2 pointer_{0}; // position that the hand reaches for: -1 to 1 across the window, +x right, +y up
    hands::Side hand_ = hands::Side::Right; // the player's chosen hand
    bool wasDown_ = false;
    bool toggled_ = false;   // the hand is closed; used with Closing::Toggle
    bool awaitsOpen_ = true; // true until the press that ended a menu is released
    bool snapped_ = false;   // the stick has turned the view by a step and has not come back yet
};

// The inputs of a recording; compares its states with those that the inputs lead to now.
struct ReplaySource {
    // Reads the next input; false: there is none.
    bool next(game::TickInput& input);
    void compare(uint64_t stateHash); // compares the state after that input
    bool atEnd() const { return !verdict || recording.atEnd(); }

    sim::RecordingReader recording;
    uint64_t hash = 0;       // recorded hash of the state after the last input
    Status verdict = Done{}; // an error if a state differed or the file is damaged
};

// The hand tracking device of a session, which has threads of its own. While it sees no hands, the mouse
// moves them.
class TrackedHands {
  public:
    // live: real time; else frames count by their time stamps. source: Leap, Webcam, or Auto, which never
    // opens a webcam: a camera looks at people and must be asked for.
    TrackedHands(const HandSourceChoice& source, const HandOptions& options, const hands::HandRig& rig,
                 bool live);

    // Takes the device's new frames, once a frame of the display.
    void frame(double elapsed_s);

    // Replaces the mouse's hands in `input` by those of the device, if it sees hands; once a tick, which lies
    // ago_s before the frame's time.
    void tick(game::TickInput& input, float ago_s) { choice_.tick(hands_, input.hands, ago_s, sim::kTick_s); }

    // Sets the elbow directions that the device sees, for arms in the picture; they are not recorded.
    void showElbows(game::Snapshot& shown) const {
        for (size_t side = 0; side < 2; ++side)
            shown.hands[side].towardsElbow = shown.worldFromView * towardsElbow_[side];
    }

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
        return game::Notice{"To find your hands before the webcam, run once: {}",
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

// Dive, seed and source of input of a session.
struct SessionConfig {
    game::SpeciesTable species;
    game::DiveFile dive;
    game::DiveRules rules;
    // Settings that shaped the inputs, for a recording's header; a replay does not need them.
    std::map<std::string, std::string> inputSettings;
    hands::HandRig rig;
    uint64_t seed = 1;
    HandSourceChoice handSource;
    HandOptions hands; // options of the tracking devices
    bool live = true;  // runs in real time, with somebody watching
    std::optional<game::Script> script;
    std::optional<sim::RecordingReader> replay;
};

// Returns a random seed of six digits, so that it can be read out and typed.
uint64_t drawnSeed();

// Reads the files that the options name. A script or replay brings its own dive and seed.
Result<SessionConfig> makeSessionConfig(const PlayOptions& options);

struct GameSession {
    explicit GameSession(const SessionConfig& config);
    // Sets the tracking device, if a person plays with the mouse.
    void track(const SessionConfig& config) {
        tracked.reset();
        if (std::holds_alternative<MouseSource>(source) && config.handSource.kind != HandSourceKind::Mouse)
            tracked.emplace(config.handSource, config.hands, config.rig, config.live);
    }

    // Writes every tick to that file, from now on until endRecording().
    Status record(const Path& file);
    // Ends the recording. Returns the first error that kept the file from being complete.
    Status endRecording() {
        if (recording_) recorded_ = recording_->finish();
        recording_.reset();
        return recorded_;
    }

    // Runs the ticks of this much time.
    void advance(double elapsed_s);

    HandSource source;
    std::optional<TrackedHands> tracked; // tracking device of a dive played by mouse
    game::Dive dive;
    sim::FixedStep clock;
    game::Snapshot before, after, shown;
    game::Events events; // of this frame's ticks
    uint64_t ticks = 0;
    std::optional<xr::Pose> head; // the headset's head pose; empty: the source has the head's pose
    bool paused = false, restart = false;
    bool ended = false; // the source has no more input
    Status verdict = Done{};
    std::string summary; // of a script that has ended: its file's name, and the hash of all states

  private:
    // Runs one tick, ago_s before this frame. share: its time as a fraction, last frame 0 to this frame 1.
    void tick(float share, float ago_s);
    void addToRecording(const game::TickInput& input, uint64_t hash);
    std::map<std::string, std::string> inputSettings_; // for the recording's header
    std::optional<sim::RecordingWriter> recording_;
    Status recorded_ = Done{};           // error at which the recording ended while the game goes on
    std::optional<xr::Pose> headBefore_; // of the last frame
};

// The game time that each frame of a dive takes, and the time of its drawing.
class FrameClock {
  public:
    enum class Mode {
        RealTime,  // game time follows the system's clock
        FixedStep, // every frame takes 1 / fps, and shows just its frame of the video
        TimeDemo   // FixedStep for the dive, as fast as possible, while the video runs in real time
    };
    FrameClock(Mode mode, double fps) : mode_(mode), fps_(fps) {}

    void beginFrame() {
        const Clock::time_point now = Clock::now();
        if (++frame_ == 0) start_ = frameStart_ = now;
        wall_s_ = Seconds(now - frameStart_).count();
        frameStart_ = now;
    }
    Mode mode() const { return mode_; }
    uint64_t frame() const { return frame_; } // 0: the first frame
    double sinceBegin_ms() const { return 1e3 * Seconds(Clock::now() - frameStart_).count(); }

    // Returns the dive's time since the last frame. display: that time by the display; empty: unknown.
    double elapsed_s(std::optional<double> display) const {
        constexpr double kMaximum_s = 0.5; // a longer pause is not made up for
        if (display) return std::min(*display, kMaximum_s);
        if (mode_ == Mode::RealTime) return std::min(wall_s_, kMaximum_s);
        return frame_ == 0 ? 0 : 1 / fps_;
    }
    double video_s(double dive_s) const {
        return mode_ == Mode::TimeDemo ? Seconds(Clock::now() - start_).count() : dive_s;
    }
    bool exactVideo() const { return mode_ == Mode::FixedStep; }

    // Waits at the end of a frame with a live video, which runs in real time, so that fixed steps are not
    // faster than it.
    void waitForLiveVideo() const {
        if (mode_ != Mode::FixedStep) return;
        const Seconds due(static_cast<double>(frame_ + 1) / fps_);
        std::this_thread::sleep_until(start_ + std::chrono::duration_cast<Clock::duration>(due));
    }

  private:
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    Mode mode_;
    double fps_;
    uint64_t frame_ = ~uint64_t{0}; // before the first frame
    Clock::time_point start_, frameStart_;
    double wall_s_ = 0; // from the last frame to this one
};

struct Series : std::vector<float> { // in the order of arrival
    Series() { reserve(16384); }     // so that no frame allocates
};

// Frame times, counts and the state hash of a session: for the developer's panel and for --stats.
struct Statistics {
    std::string renderer;
    Series frame_ms; // without the first frame
    std::vector<std::pair<const char*, Series>>
        parts;                             // time of each part of a frame (engine/gl/PassTimers.h), as frame_ms
    Series light_ms, decode_ms, upload_ms; // per frame of the video
    // Latency of a live video, from the arrival of a frame's last byte until the picture that first shows it
    // is drawn; and LivePlayer::displayFrames().
    Series liveLatency_ms, liveDisplayFrames;
    media::LiveCounts live;
    float sim_ms = 0; // of the last frame, as are draws and triangles
    int draws = 0, triangles = 0;
    float minScale = 1; // least Quality::scale, see DynamicQuality.h
    int caught = 0, score = 0;
    uint64_t stateHash = 0, ticks = 0;

    // Adds the time of a part of the frame that is measured, before its frame_ms.
    void addPart(const char* part, float ms) {
        auto known = std::ranges::find(parts, part, &decltype(parts)::value_type::first);
        if (known == parts.end()) known = parts.insert(known, {part, {}});
        known->second.resize(frame_ms.size(), 0); // frames before the part's first
        known->second.push_back(ms);
    }
};

// Runs one session, with a picture or without: its clock, the mouse's hand, ticks, recording, end and
// figures.
class DiveRunner {
  public:
    // The options must outlive this.
    DiveRunner(const SessionConfig& config, const PlayOptions& options, FrameClock::Mode clockMode)
        : session(config), clock(clockMode, static_cast<double>(options.fps)), options_(options) {}

    // Begins a frame. display_s: time between two pictures by the display; empty: it does not know.
    void beginFrame(std::optional<double> display_s) {
        clock.beginFrame();
        elapsed_s = clock.elapsed_s(display_s) * static_cast<double>(options_.speed);
    }
    // Moves the mouse's hand, if the session has it. controls: null where nobody plays. size: of the picture.
    void moveMouse(const Controls* controls, glm::ivec2 size);
    // Returns whether the session is complete; one that nobody watches ends with its results.
    bool isOver() const;
    // Ends the session: completes its recording and its figures. Returns its verdict.
    Status end(Statistics& statistics);

    GameSession session;
    FrameClock clock;
    double elapsed_s = 0; // game time of this frame

  private:
    const PlayOptions& options_;
};

} // namespace shoal::app
