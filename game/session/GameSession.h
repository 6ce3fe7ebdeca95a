// One run of the simulation with its source of input and its recording. Main thread.
#pragma once

#include "engine/sim/FixedStep.h"
#include "engine/sim/Recording.h"
#include "engine/xr/Tracked.h"
#include "game/rules/Dive.h"
#include "game/session/HandSource.h"
#include "game/settings/PlayOptions.h"

#include <map>
#include <optional>
#include <string>

namespace shoal::app {

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

// Returns the options' hand source, with the defaults that depend on other options.
Result<HandSourceChoice> handSourceFor(const PlayOptions& options);

// Reads the files that the options name. A script or replay brings its own dive and seed.
Result<SessionConfig> makeSessionConfig(const PlayOptions& options);

struct GameSession {
    explicit GameSession(const SessionConfig& config);
    // Sets the tracking device, if a person plays with the mouse.
    void track(const SessionConfig& config);

    // Writes every tick to that file, from now on until endRecording().
    Status record(const Path& file);
    // Ends the recording. Returns the first error that kept the file from being complete.
    Status endRecording();

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
    game::Events tickEvents_;
};

} // namespace shoal::app
