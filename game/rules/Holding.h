// A fish in a hand: how the fingers lie on it, how hard they press and what force they can bear together (see
// engine/physics/ContactModel.h, steps 4 and 5), how it goes with the hand, struggles, and slips out.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/Capsule.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Creatures.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

// Wraps the hand's fingers around the body: sets the shown joints and the presses.
void wrapFingers(const physics::Capsule& body, Hand&);

// Eases the shown joints towards where the fingers rest: the last step of a tick.
void easeFingers(Hand&);

// Returns whether the contacts of both hands with the fish can bear the force asked_N.
physics::Hold holdOn(int fish, const Hands&, std::span<const physics::Contact>, glm::vec3 asked_N);

// Moves the held fish with the hands that hold them.
void followHands(const Hands&, std::span<Fish>);

// Bends and beats a fish that struggles in the hand: it curls away from the palm, thrashes, gathers strength,
// thrashes again, each time less.
void struggle(Fish&, const Hand&, Random&);

// Advances how fish `id` lies in hand `h`: friction against its struggle, the water's drag and the hand's
// acceleration. Returns false once it has slipped out.
bool keepsHold(Fish&, int id, const Species&, const Hands&, int h, std::span<const physics::Contact>);

} // namespace shoal::game
