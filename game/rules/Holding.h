// Motion of a fish in a hand, and of the fingers that lie on it.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

// Returns the strength of a fish's struggle after so long in a hand, 1 at first; and its tail's beat, -1
// to 1.
float tired(float held_s);
float tailBeat(const Fish&);

// Moves held fish with the hands that hold them.
void followHands(const Hands&, std::span<Fish>);

// Bends and beats a fish that struggles in the hand: it curls away from the palm, thrashes, gathers strength,
// thrashes again, each time less.
void struggle(Fish&, const Hand&, Random&);

// Eases the shown joints towards where the fingers rest: the last step of a tick.
void easeFingers(Hand&);

} // namespace shoal::game
