// The encounter of a dive: a giant (a whale), too large to catch, swims past once. It reacts to nothing, and
// nothing collides with it.
#pragma once

#include "game/rules/Creatures.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Events.h"
#include "game/rules/Score.h"

namespace shoal::game {

// Advances the giant by a tick; time_s: since the dive began, id: its creature id. The field guide counts it
// as met when it sets out.
void passBy(Passer&, const EncounterPlan&, const SpeciesTable&, float time_s, int id, Score&, Events&);

} // namespace shoal::game
