// Finds the fish that a hand reaches for, helps a hand that closes beside it, and tells why one that closed
// took nothing.
//
// Whether a hand means to take a fish is read from where both will be when the fingers have closed (distance,
// with their velocities), from how fast they are against each other, and from the side of the palm; that it
// closes is read from its aperture and the aperture's speed. A fish once meant stays so for a moment while it
// slips out of range: people close a reaction time after they have seen that they can. The ways of games with
// hands: Owlchemy Labs' Job Simulator takes the best scored object near a closing hand, not the touched one;
// Meta's Interaction SDK scores grabs and keeps a grab selected with hysteresis; Prachyabrued & Borst 2012,
// "Virtual grasp release method and evaluation", show the hand where it helps the user rather than where it
// is. Here the help is bounded: hand and fish each go part of the way, at limited speed, while it closes.
#pragma once

#include "game/rules/Creatures.h"
#include "game/rules/DiveRules.h"
#include "game/rules/Events.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

// Updates each hand's intent and how catchable that makes each fish; called every tick before anything moves.
// A hand or a fish that the film hides takes no part.
void readIntents(Hands&, const Viewpoint&, const SpeciesTable&, std::span<Fish>, Assist, const FilmMoment&);

// Moves a closing hand towards the fish it reaches for, and the fish into the hand, both by as much as a tick
// allows. The hand's part shows in the next tick's joints.
void helpClosing(Fish&, const Species&, Hand&, const Viewpoint&, Assist);

// Returns whether the hand is closing, from its grip and the grip's speed.
bool isClosing(const Hand&);

// Returns whether the hand is being helped to that fish, which therefore is not frightened by it.
bool helpedTo(const Hand&, int fish);

// Returns why a hand whose grip has just closed would take nothing. The fish that it was for is the one
// nearest to the line of sight from the eyes through the grasp centre:
//   Nothing   no fish is near the line;
//   TooFast   the hand was faster than kFastHand_mps while it closed, or the fish flees;
//   TooFar    the fish is beyond what the fingers reach, farther along the line than they;
//   Behind    it is on the near side of the hand, or beside it and swimming away: the hand came from behind;
//   TooEarly  it is beside the hand and not yet there.
Miss missOf(const Hand&, const Viewpoint&, const SpeciesTable&, std::span<const Fish>, const FilmMoment&);

EventKind eventOf(Miss);

constexpr float kFastHand_mps = 1.2f;

} // namespace shoal::game
