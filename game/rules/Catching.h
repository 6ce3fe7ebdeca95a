// Decides which fish a closing hand takes hold of, when holding it counts as a catch, and when it is let go.
#pragma once

#include "engine/physics/ContactWorld.h"
#include "game/rules/Creatures.h"
#include "game/rules/DiveRules.h"
#include "game/rules/Events.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Hand.h"
#include "game/rules/Score.h"

#include <span>

namespace shoal::game {

constexpr int kCloseWindow = 12;  // ticks after it has stopped closing in which a hand still takes hold
constexpr int kHelpedWindow = 22; // the same for a hand that is helped to a fish
constexpr float kGraspRadius_m = 0.075f; // closing fingers draw in fish this near to hands::graspCentre
constexpr float kHoldToCatch_s = 1;
constexpr float kShowCatch_s = 0.2f; // time from the catch to the release
constexpr float kUncatchable_s = 2;  // time before a fish can be caught again, after a catch or the shark
constexpr float kSting_s = 1;        // time in which a stung hand cannot hold

// Returns the distance from the hand's grasp centre to the body's surface, metres.
float graspGap(const Fish&, const Species&, const Hand&);
bool onPalmSide(const Fish&, const Hand&);

// Inputs of closeHands() that it does not change.
struct Closing {
    const SpeciesTable& species;
    std::span<const physics::Contact> contacts;
    const Viewpoint& view;
    FilmMoment film{}; // a fish or hand that it hides takes no part
    Assist assist = Assist::None;
    uint32_t tick = 0;
    bool takes = true; // hands take nothing once the dive is over
};

// Updates each hand's closing and opening. A closing hand takes hold of a fish that its fingers, or both
// hands, press from opposing sides; it is helped to the fish it reaches for, and stung by one that stings.
void closeHands(Hands&, std::span<Fish>, const Closing&, Events&);

// Lets the held fish go: with a Release if it has counted as a catch, else an Escape. h: 0 left, 1 right.
void drop(Hand&, int h, const SpeciesTable&, std::span<Fish>, Events&);

// Advances all holds, after everything has moved: a held fish may slip out, or is caught and then let go.
void countCatches(Hands&, const SpeciesTable&, std::span<Fish>, std::span<const physics::Contact>, Score&,
                  Events&);

} // namespace shoal::game
