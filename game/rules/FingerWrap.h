// How the fingers of a closing hand lie on the fish between them, how hard they press, and what force they
// can bear together. See engine/physics/ContactModel.h, steps 4 and 5.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

// Wraps the hand's fingers around the body: sets the shown joints and the presses.
void wrapFingers(const physics::Capsule& body, Hand&);

// Eases the shown joints towards where the fingers rest: the last step of a tick.
void easeFingers(Hand&);

// Whether all that presses on the fish, of both hands, bears the force that is asked of it.
physics::Hold holdOn(int fish, const Hands&, std::span<const physics::Contact>, glm::vec3 asked_N);

} // namespace shoal::game
