// One run of the simulation with its source of input and its recording. Main thread.
#pragma once

#include "engine/sim/FixedStep.h"
#include "engine/sim/Recording.h"
#include "engine/xr/Tracked.h"
#include "game/rules/Dive.h"
#include "game/session/HandSource.h"
#include "game/settings/PlayOptions.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <thread>

namespace shoal::app {

struct Statistics;

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
        if (!display && mode_ != Mode::RealTime) return frame_ == 0 ? 0 : 1 / fps_;
        return std::min(display.value_or(wall_s_), sim::FixedStep::kMaxCatchUp_s);
    }
    double video_s(double dive_s) const {
        return mode_ == Mode::TimeDemo ? Seconds(Clock::now() - start_).count() : dive_s;
    }
    bool exactVideo() const { return mode_ == Mode::FixedStep; }

    // Waits after a frame with a live video, so that fixed steps are not faster than its real time.
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

// Runs one session, with a picture or without: clock, the mouse's hand, ticks, recording, end and figures.
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
    float dt_s() const { return static_cast<float>(elapsed_s); }
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
