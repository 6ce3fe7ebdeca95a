// Motion of a fish in a hand, and of the fingers that lie on it.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

// tired() returns the strength of a fish's struggle after held_s in a hand, 1 at first; tailBeat() returns
// the deflection of its tail, -1 to 1.
float tired(float held_s);
float tailBeat(const Fish&);

// Moves held fish with the hands that hold them.
void followHands(const Hands&, std::span<Fish>);

// Bends the body and beats the tail of a fish in the hand: it curls away from the palm, and bouts of
// struggling alternate with rests, each bout weaker than the last.
void struggle(Fish&, const Hand&, Random&);

// Eases the shown joints towards where the fingers rest: the last step of a tick.
void easeFingers(Hand&);

} // namespace shoal::game
