// What frightens fish, and where they flee to.
#pragma once

#include "engine/core/Random.h"
#include "game/rules/Events.h"
#include "game/rules/Fish.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

// The fish flees from a place, away from the player; a Startle event once per fright. No effect on one that
// is in a hand or a mouth.
void startle(Fish&, int id, glm::vec3 from, Random&, EventSink&);

// Startles fish that a fast hand comes upon.
void frightenByHands(const Hands&, const SpeciesTable&, std::span<Fish>, Random&, EventSink&);

} // namespace shoal::game
