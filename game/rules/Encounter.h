// The encounter of a dive: a giant (a whale), too large to catch, swims past once. It reacts to nothing, and
// nothing collides with it.
#pragma once

#include "game/rules/DiveState.h"
#include "game/rules/Events.h"

namespace shoal::game {

// Advances the giant by a tick; id: its creature id. The field guide counts it as met when it sets out.
void passBy(Passer&, int id, Score&, const DiveContext&, Events&);

} // namespace shoal::game
