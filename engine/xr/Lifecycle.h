// The states of an OpenXR session, and what the program must do in each: a table. Needs nothing of OpenXR.
#pragma once

#include <array>
#include <cstddef>

namespace shoal::xr {

// XrSessionState, with the same numbers.
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

// Once, on entering a state.
enum class Step {
    Nothing,
    Begin, // the session
    End,   // the session
    Leave, // the program: the player asked the runtime to
    Lost,  // ends the program with an error: the headset is gone
};

struct Duty {
    Step step = Step::Nothing;
    bool frames = false; // wait for frames and hand them in, even empty ones
    bool drawn = false;  // the player sees them
    bool plays = false;  // the dive goes on: the headset is worn and hands are ours
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
