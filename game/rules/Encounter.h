// Something too large to catch that passes once in a dive: a whale. It heeds nobody, and nothing collides
// with it.
#pragma once

#include "game/rules/Creatures.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Events.h"
#include "game/rules/Score.h"

namespace shoal::game {

// A tick of its way; time_s: since the dive began, id: its creature's. It counts as met, for the field guide,
// when it sets out.
void passBy(Passer&, const EncounterPlan&, const SpeciesTable&, float time_s, int id, Score&, Events&);

} // namespace shoal::game
