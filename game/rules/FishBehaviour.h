// Behaviour of free fish: schooling, choice of route, swimming and escape.
//
// Schooling has zones of repulsion, orientation and attraction around each fish, as in Couzin, Krause, James,
// Ruxton & Franks 2002, "Collective memory and spatial sorting in animal groups"; here their edges are soft
// and forces add, so that headings do not jump as a neighbour crosses an edge.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

// Moves fish that would start behind a surface of the film towards the camera, before they are first seen.
void startInFreeSpace(std::span<Fish>, const DiveContext&);

// Influence of all other fish on one fish, gathered once a tick.
struct Neighbours {
    glm::vec3 giveWay{0};  // m/s, away from fish that are, or soon will be, too near
    glm::vec3 push{0};     // m/s, added to Fish::push: separates touching bodies faster than steering
    glm::vec3 headings{0}; // sum of the headings of companions in the zone of orientation
    glm::vec3 towards{0};  // sum of the vectors to companions in the zone of attraction, metres
    int aligned = 0, attracted = 0; // number of companions in `headings`, in `towards`
};

// Writes one entry of `out` for each fish.
void gatherNeighbours(std::span<const Fish>, const SpeciesTable&, std::span<Neighbours> out);

// Advances all fish by a tick: free fish swim, held ones struggle.
void swimFish(std::span<Fish>, const DiveContext&, std::span<Neighbours>, Random&);

// Makes the fish flee from a place and away from the player, with one Startle event per fright. A fish in a
// hand or a mouth is not affected.
void startle(Fish&, int id, glm::vec3 from, const DiveContext&, Random&, Events&);

// Returns how nearly the hand frightens a fish in front of it: 0 up to two thirds of the closing speed that
// frightens, and 1 from that speed on.
float hasteOf(const Hand&, std::span<const Fish>, const DiveContext&);

// Startles fish that a fast hand approaches.
void frightenByHands(std::span<Fish>, const DiveContext&, Random&, Events&);

// Fish come to look at a hand that rests, open and in the player's view, one or two at a time: they swim to
// about a hand's width before the palm, linger and leave. So distant fish come within reach of a player who
// waits. A fast or closing hand ends a visit. A cracked mussel in a hand (Hand::baitLeft_s) draws more of
// them, from all around, and they do not fear it. Begins and ends visits; called every tick.
void chooseVisitors(Hands&, std::span<Fish>, const DiveContext&, Random&);

// Returns whether the fish comes to feed on a mussel.
inline bool feeds(const Fish& f, const Hands& hands) {
    return f.visit.hand >= 0 && hands[f.visit.hand].baitLeft_s > 0;
}

// Returns the place in front of the palm that a visiting fish swims to.
glm::vec3 visitedPlace(const Hand&);

} // namespace shoal::game
