// What free fish do: keep company, choose their way, swim it, and flee.
//
// Schooling has zones of repulsion, orientation and attraction around each fish, as in Couzin, Krause, James,
// Ruxton & Franks 2002, "Collective memory and spatial sorting in animal groups"; here their edges are soft
// and forces add, so that headings do not jump as a neighbour crosses an edge.
#pragma once

#include "engine/core/Random.h"
#include "game/rules/Creatures.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Events.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

void spawnFish(const DiveFiles&, Random&, std::vector<Fish>& out); // at the beginning of a dive

// Before anybody sees them: those that would be behind what the film shows come nearer.
void startInRoom(std::span<Fish>, const SpeciesTable&, const FilmMoment&);

// What a fish makes of those around it, gathered once a tick.
struct Neighbours {
    glm::vec3 giveWay{0};  // m/s, away from who is or soon will be too near
    glm::vec3 push{0};     // m/s, as steering comes too late for bodies that touch
    glm::vec3 headings{0}; // sum over the companions in the zone of orientation
    glm::vec3 towards{0};  // sum of the ways to those in the zone of attraction, metres
    int aligned = 0, attracted = 0;
};

// out: one for each fish.
void gatherNeighbours(std::span<const Fish>, const SpeciesTable&, std::span<Neighbours> out);

// Where the fish wants to go for the next while: wander and route. Companions follow their leader's choice.
void chooseRoute(Fish&, int id, std::span<const Fish>, const School&, const Species&, Random&);

// What fish see of others than fish.
struct Surroundings {
    const DiveFile& dive;
    const SpeciesTable& species;
    const Hands& hands;
    const Shark& shark;
    const FilmMoment& film;
};

// Advances all fish by a tick: those that are free swim, those in a hand struggle.
// neighbours: scratch, one for each fish.
void swimFish(std::span<Fish>, const Surroundings&, std::span<Neighbours> neighbours, Random&);

// The fish flees from a place, away from the player; a Startle event once per fright. No effect on one that
// is in a hand or a mouth.
void startle(Fish&, int id, glm::vec3 from, Random&, Events&);

// Startles fish that a fast hand comes upon.
void frightenByHands(const Hands&, const SpeciesTable&, std::span<Fish>, Random&, Events&);

} // namespace shoal::game
