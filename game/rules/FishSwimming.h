// How a free fish swims: along its circle, with its companions, away from hands, shark and the player's eyes,
// and in flight.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Fish.h"
#include "game/rules/Hand.h"
#include "game/rules/Schooling.h"
#include "game/rules/Shark.h"

#include <span>

namespace shoal::game {

// What fish see of others than fish.
struct Surroundings {
    const DiveFile& dive;
    const SpeciesTable& species;
    const Hands& hands;
    const Shark& shark;
};

// Advances all fish by a tick: those that are free swim, those in a hand struggle.
// neighbours: scratch, one for each fish.
void swimFish(std::span<Fish>, const Surroundings&, std::span<Neighbours> neighbours, Random&);

} // namespace shoal::game
