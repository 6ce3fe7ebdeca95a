// Finds the fish that a hand reaches for, helps a hand that closes beside the fish, and tells why a hand that
// closed took nothing.
//
// The target of a hand is the fish with the lowest cost: from the distance now and when the fingers will
// have closed, the relative speed, and the side on which the palm is. The grip and its rate of change tell
// whether the hand closes. A target that leaves the range is kept for a moment, because a player needs a
// reaction time to close the hand. Games score objects near a closing hand in this way (Owlchemy Labs' Job
// Simulator, Meta's Interaction SDK), and Prachyabrued & Borst 2012, "Virtual grasp release method and
// evaluation", draw the hand where it helps the user. Here a closing hand and its fish move towards each
// other, each part of the way and at limited speed.
#pragma once

#include "game/rules/DiveState.h"

#include <optional>
#include <span>

namespace shoal::game {

constexpr float kGraspRadius_m = 0.075f; // closing fingers draw in fish this near to hands::graspCentre

// Returns the distance from the hand's grasp centre to the body's surface, metres.
inline float graspGap(const Fish& f, const Species& kind, const Hand& hand) {
    return physics::separation({hand.graspCentre, hand.graspCentre, 0}, capsuleOf(f, kind));
}
inline bool onPalmSide(const Fish& f, const Hand& hand) {
    return glm::dot(f.position - hand.palm().position, hand.outOfPalm()) > 0;
}

// Updates each hand's intent and how catchable that makes each fish; called every tick before anything moves.
// Ignores hands and fish that the film hides.
void readIntents(Hands&, std::span<Fish>, const DiveContext&);

// Returns the value of Fish::push that moves the fish into the hollow of the hand, m/s.
glm::vec3 pushIntoHollow(const Fish&, const Species&, const Hand&);

// Moves a closing hand towards the fish it reaches for, and accelerates the fish into the hand, each by at
// most a tick's limit. The next tick's joints are displaced with the hand.
void helpClosing(Fish&, Hand&, const DiveContext&);

// Returns whether the hand is closing, from its grip and the grip's speed.
bool isClosing(const Hand&);

// Returns whether the hand is being helped to that fish, which therefore is not frightened by it.
inline bool helpedTo(const Hand& hand, int fish) { return hand.intent.helps && hand.intent.fish == fish; }

constexpr float kFastHand_mps = 1.2f;

// Returns why a hand whose grip has just closed would take nothing; see EventKind. The intended fish is the
// one nearest to the line of sight from the eyes through the grasp centre. TooFast: the hand was faster than
// kFastHand_mps while it closed, or the fish flees.
Miss whyMissed(const Hand&, std::span<const Fish>, const DiveContext&);

EventKind eventOf(Miss);

// Returns the fish that an open, empty hand points at and that is farther away than it reaches; -1: none.
int fishOutOfReach(const Hand&, std::span<const Fish>, const DiveContext&);

// Returns how far from the eye, in metres, to place a pointer's hand on its ray: as far as a catchable fish
// near the ray will be in a moment; empty if there is none. rayView: unit, viewer's frame; hand_m: the hand's
// distance now. target: the fish's id, -1 none; it changes once the pointer is clearly nearer to another
// fish. Each pointer keeps its own target outside the simulation's state. Call once a frame.
std::optional<float> reachHelp(const Snapshot&, const SpeciesTable&, glm::vec3 rayView, float hand_m,
                               int& target);

} // namespace shoal::game
