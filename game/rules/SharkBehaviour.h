// What the shark does: far circles, visits, threats, strikes at what a hand holds; and how it swims to do so.
#pragma once

#include "engine/physics/ContactWorld.h"
#include "game/rules/Catching.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Events.h"
#include "game/rules/Fish.h"
#include "game/rules/Hand.h"
#include "game/rules/Shark.h"

#include <span>

namespace shoal::game {

// What the shark knows of the dive.
struct SharkView {
    const DiveFile& dive;
    const SpeciesTable& species;
    const Hands& hands;
    std::span<const Fish> fish;
    float time_s;    // since the dive began
    bool diveIsOver; // no new visits
};

// Chooses what it does next.
void decide(Shark&, const SharkView&, EventSink&);

// Swims for a tick, as what it does demands.
void swimShark(Shark&, const SharkView&);

// At the end of a strike: takes the fish out of the hand, carries it off, loses it far out.
void bite(Shark&, const SpeciesTable&, Hands&, std::span<Fish>, Score&, EventSink&);

// A hand that its body meets is bumped, and drops what it holds.
void bumpHands(Shark&, const SpeciesTable&, std::span<const physics::Contact>, Hands&, std::span<Fish>,
               EventSink&);

} // namespace shoal::game
