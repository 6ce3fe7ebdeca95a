// How a fish in a hand goes with the hand, struggles, and slips out of it.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Fish.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

// Moves the held fish with the hands that hold them.
void followHands(const Hands&, std::span<Fish>);

// Bends and beats a fish that struggles in the hand: it curls away from the palm, thrashes, gathers strength,
// thrashes again, each time less.
void struggle(Fish&, const Hand&, Random&);

// Where the hand `h` keeps fish `id`: friction against what its struggle, the water and the hand's
// acceleration ask for. False: it has slipped out.
bool keepsHold(Fish&, int id, const Species&, const Hands&, int h, std::span<const physics::Contact>);

} // namespace shoal::game
