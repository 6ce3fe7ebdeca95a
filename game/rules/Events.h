// Events of a dive, for sound, captions, haptics and playthroughs. Each kind has a row in
// game/feedback/EventTable.h with its name, sound, caption and haptic pulse.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace shoal::game {

enum class EventKind {
    Touch,   // a finger or palm meets a fish
    Startle, // a fish flees; once per fright
    Grab,    // a hand closes on a fish
    Catch,   // held long enough: it counts
    Release, // let go after a catch
    Escape,  // let go, or slipped out, before it counted
    Miss,    // a hand closed on nothing: no fish was near it
    // A hand closed beside a fish and did not get it, with the reason (game/rules/Intent.h):
    MissTooFar,   // the fish was farther away than the hand
    MissTooFast,  // the hand was too fast
    MissTooEarly, // the fish had not yet come between the fingers
    MissBehind,   // the hand was behind the fish
    Sting,        // a hand closed on something that stings, and cannot hold for a while
    Goal,         // a goal of the dive is reached
    Encounter,    // something large sets out to pass by
    SharkNear,    // the shark turns towards the player
    SharkBump,    // the shark hits a hand
    SharkSteal,   // the shark takes a fish out of a hand
    DiveStart,
    DiveOver,
};

struct Event {
    EventKind kind;
    int creature = -1;                   // CreatureView::id; -1: none, as for hand and part
    int hand = -1;                       // 0 left, 1 right
    std::optional<glm::vec3> position{}; // world frame; empty: everywhere
    int part = -1;                       // hands::Finger or hands::kPalmPart
    float closing_mps = 0;               // closing speed of hand and creature
    // Set for a Catch: its species, its points (combo included), and the combo, which multiplies the points.
    int species = -1; // index into the species table
    int points = 0;
    int combo = 0;
    int goal = -1; // index into DiveFile::goals, for a Goal
};

using Events = std::vector<Event>; // functions append to it

} // namespace shoal::game
