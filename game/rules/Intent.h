// Finds the fish that a hand reaches for, and helps a hand that closes beside it.
//
// Whether a hand means to take a fish is read from where both will be when the fingers have closed (distance,
// with their velocities), from how fast they are against each other, and from the side of the palm; that it
// closes is read from its aperture and the aperture's speed. A fish once meant stays so for a moment while it
// slips out of range: people close a reaction time after they have seen that they can. Games score objects
// near a closing hand in this way (Owlchemy Labs' Job Simulator, Meta's Interaction SDK), and Prachyabrued &
// Borst 2012, "Virtual grasp release method and evaluation", show the hand where it helps the user. Here hand
// and fish each go part of the way, at limited speed, while the hand closes.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

constexpr float kGraspRadius_m = 0.075f; // closing fingers draw in fish this near to hands::graspCentre

// Returns the distance from the hand's grasp centre to the body's surface, metres.
float graspGap(const Fish&, const Species&, const Hand&);
bool onPalmSide(const Fish&, const Hand&);

// Updates each hand's intent and how catchable that makes each fish; called every tick before anything moves.
// A hand or a fish that the film hides takes no part.
void readIntents(Hands&, std::span<Fish>, const DiveContext&);

// Returns the push with which the fish goes into the hollow of the hand.
glm::vec3 pushIntoHollow(const Fish&, const Species&, const Hand&);

// Moves a closing hand towards the fish it reaches for, and the fish into the hand, both by as much as a tick
// allows. The hand's part shows in the next tick's joints.
void helpClosing(Fish&, Hand&, const DiveContext&);

// Returns whether the hand is closing, from its grip and the grip's speed.
bool isClosing(const Hand&);

// Returns whether the hand is being helped to that fish, which therefore is not frightened by it.
bool helpedTo(const Hand&, int fish);

} // namespace shoal::game
