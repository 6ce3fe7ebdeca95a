// Loose things: mussels, stones and bottles that players pick up, crack, keep and throw. Each is a Fish of
// the table of creatures, so that what helps, shows and tells of a hand's grasp is the same for all; but it
// does not swim. It drifts on torn-off seaweed, as mussels and stones do in the sea (Emery and Tschudy 1941,
// "Transportation of rock by kelp"), until a hand takes it; from then on the physics world moves it.
//
// A mussel held for half a second cracks; fish around lose their fear and feed at the hand. A stone frightens
// the fish that it passes, and turns the shark away where it passes close before its eyes; on the snout of a
// striking shark it saves the fish. A bottle comes up from the bottom and rises out of reach; held as long as
// a fish it is out of the sea. A mussel or stone that lay unseen a while drifts at its old place again.
#pragma once

#include "engine/physics/World.h"
#include "game/rules/DiveState.h"

#include <span>
#include <vector>

namespace shoal::game {

// Makes a thing wait where it is at first: a bottle at the bottom, out of sight, and others on seaweed.
void startDrifting(Fish&, const Species&);

// Returns how long a hand must hold it to crack, catch or collect it; 0: holding it changes nothing.
float holdTime_s(const Species&);

// Lets a thing go that a hand held: thrown if the hand moves, with the mean velocity of its palm in the last
// kThrowTicks. Where help is on, a stone's throw is aimed at the animal that lies near its path or near the
// line of sight through the hand.
void letGo(Fish&, int id, const Hand&, int h, const DiveContext&, Events&);

// Advances the hold of a thing: draws it into the hand, and cracks or collects it in time. Returns false once
// the hand opens or has no more use of it.
bool holdThing(Fish&, int id, Hand&, int h, Score&, const DiveContext&, Events&);

// Counts down the time in which cracked mussels draw fish, and tells whether any came. told: whether the
// player has been told in this dive that none did.
void offerBait(Hands&, std::span<const Fish>, bool& told, Events&);

// Moves all loose things by a tick, after everything else has moved; see above for what they do on their way.
class ThingMover {
  public:
    void move(physics::World&, std::span<Fish>, Shark&, const DiveContext&, Random&, Events&);

  private: // scratch memory, no state
    std::vector<physics::LooseBody> loose_;
    std::vector<physics::Body> bodies_;
    std::vector<physics::Knock> knocks_;
};

} // namespace shoal::game
