// Finds the fish that a hand reaches for, helps a hand that closes beside the fish, and tells why a hand that
// closed took nothing.
//
// The fish that a hand means to take is inferred from their distance, now and when the fingers will have
// closed, from their relative speed, and from the side on which the palm is. Whether the hand closes is
// inferred from its grip and the grip's rate of change. A target that leaves the range is kept for a moment,
// because people close a reaction time after they have seen that they can. Games score objects near a closing
// hand in this way (Owlchemy Labs' Job Simulator, Meta's Interaction SDK), and Prachyabrued & Borst 2012,
// "Virtual grasp release method and evaluation", show the hand where it helps the user. Here hand and fish
// each move part of the way towards the other, at limited speed, while the hand closes.
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
// A hand or a fish that the film hides takes no part.
void readIntents(Hands&, std::span<Fish>, const DiveContext&);

// Returns the value of Fish::push that moves the fish into the hollow of the hand, m/s.
glm::vec3 pushIntoHollow(const Fish&, const Species&, const Hand&);

// Moves a closing hand towards the fish it reaches for, and accelerates the fish into the hand, both within a
// tick's limits. The hand's displacement takes effect in the next tick's joints.
void helpClosing(Fish&, Hand&, const DiveContext&);

// Returns whether the hand is closing, from its grip and the grip's speed.
bool isClosing(const Hand&);

// Returns whether the hand is being helped to that fish, which therefore is not frightened by it.
inline bool helpedTo(const Hand& hand, int fish) { return hand.intent.helps && hand.intent.fish == fish; }

constexpr float kFastHand_mps = 1.2f;

// Returns why a hand whose grip has just closed would take nothing; see EventKind. The intended fish is the
// one nearest to the line of sight from the eyes through the grasp centre. TooFast: the hand was faster than
// kFastHand_mps while it closed, or the fish flees.
Miss missOf(const Hand&, std::span<const Fish>, const DiveContext&);

EventKind eventOf(Miss);

// Returns the fish that an open, empty hand points at and that is farther away than it reaches; -1: none.
int outOfReach(const Hand&, std::span<const Fish>, const DiveContext&);

// Returns the distance from the eye, metres, that a pointer's hand on the ray should have: that of the fish
// near it, predicted a short time ahead; empty if no catchable fish is near the ray. rayView: unit, viewer's
// frame; hand_m: the hand's distance now. target: id of the fish, -1 none; it stays until the pointer is
// clearly nearer to another. Each pointer has its own, which is no part of the simulation's state. Called
// once a frame.
std::optional<float> reachHelp(const Snapshot&, const SpeciesTable&, glm::vec3 rayView, float hand_m,
                               int& target);

} // namespace shoal::game
