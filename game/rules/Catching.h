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
constexpr int kHelpedWindow = 22; // the same for one that is helped to a fish
constexpr float kGraspRadius_m = 0.075f; // around hands::graspCentre: what closing fingers draw in
constexpr float kHoldToCatch_s = 1;
constexpr float kShowCatch_s = 0.2f; // from the catch until it is let go
constexpr float kUncatchable_s = 2;  // after a catch, and after the shark had it
constexpr float kSting_s = 1;        // for which a stung hand holds nothing

// Distance from the hand's grasp centre to the body's surface, metres.
float graspGap(const Fish&, const Species&, const Hand&);
bool onPalmSide(const Fish&, const Hand&);

// What closing hands are subject to.
struct Closing {
    const SpeciesTable& species;
    std::span<const physics::Contact> contacts;
    const Viewpoint& view;
    FilmMoment film{}; // what it hides nobody takes
    Assist assist = Assist::None;
    uint32_t tick = 0;
    bool takes = true; // false once the dive is over
};

// Reads each hand's closing and opening, and takes hold of a fish that lies between fingers, or between both
// hands, and is held from opposing sides; helps hands that mean to. Stings those that close on what stings.
void closeHands(Hands&, std::span<Fish>, const Closing&, Events&);

// What a hand holds is let go: a Release if it has counted as a catch, else an Escape.
void drop(Hand&, int h, const SpeciesTable&, std::span<Fish>, Events&);

// After everything has moved: held fish may slip out, become a catch, and are let go after it.
void countCatches(Hands&, const SpeciesTable&, std::span<Fish>, std::span<const physics::Contact>, Score&,
                  Events&);

} // namespace shoal::game
