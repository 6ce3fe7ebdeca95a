// The states of an OpenXR session, and what each asks of the game. A table, so that it can be read and tested
// without a headset.
#pragma once

#include <array>
#include <cstddef>

namespace shoal::xr {

// As the runtime names them (XrSessionState).
enum class SessionState {
    None, // no session yet
    Idle,
    Ready,
    Synchronized,
    Visible,
    Focused,
    Stopping,
    LossPending,
    Exiting,
};
constexpr int kSessionStates = 9;

enum class Step {
    Nothing,
    Begin, // the session, now
    End,   // the session, now
    Leave, // the program: the player asked the runtime to
    Lost,  // the program, saying why: the headset is gone
};

struct Duty {
    Step step = Step::Nothing; // once, on entering the state
    bool frames = false;       // wait for frames and hand them in, even empty ones
    bool drawn = false;        // the player sees them
    bool plays = false;        // the dive goes on: the headset is worn and hands are ours
};

constexpr std::array<Duty, kSessionStates> kDuties = {{
    {},                                // None
    {},                                // Idle
    {Step::Begin, true},               // Ready
    {Step::Nothing, true},             // Synchronized
    {Step::Nothing, true, true},       // Visible: a menu of the runtime lies over the game
    {Step::Nothing, true, true, true}, // Focused
    {Step::End},                       // Stopping
    {Step::Lost},                      // LossPending
    {Step::Leave},                     // Exiting
}};

constexpr const Duty& dutyIn(SessionState state) { return kDuties[static_cast<std::size_t>(state)]; }

} // namespace shoal::xr
