// What the shark does: far circles, visits, threats, strikes at what a hand holds; and how it swims to do so.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Catching.h"
#include "game/rules/Creatures.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Events.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Hand.h"

#include <span>

namespace shoal::game {

constexpr float kJaws_m = 0.28f;         // how near its mouth must come to take a fish
constexpr float kSharkEyeRoom_m = 0.55f; // no part of its axis comes nearer to the player's eyes...
constexpr float kSharkApart_m = 1.1f;    // ...and none nearer than this but for a strike
constexpr float kStrikeTime_s = 2.5f;    // then it gives up
constexpr float kFarOut_m = 0.6f;        // so near to its circle it has left, and loses what it took
constexpr float kBumpRest_s = 2;         // it bumps no hand again for so long
constexpr float kNotice_s = 1;           // a visit begins with so long without a bump
constexpr float kTempted = 4;            // seconds of struggling that bring it early
constexpr float kStrikeFrom_m = 3.0f;    // farther away it does not try

// It never strikes unannounced: first it points at a hand, slowly, in full view, for at least so long.
constexpr float kAim_s = 1.1f;
constexpr float kAimed = 0.92f;               // cosine of the angle within which it points at it
constexpr float kThreat_s = 4.5f;             // then it breaks off
constexpr float kThreatRest_s = 2.5f;         // before the next
constexpr float kThreatFrom_m = 2.6f;         // from its mouth to the hand
constexpr float kThreatRoom_m = 0.7f;         // nearer than that it does not come
constexpr float kSoon_s = 1.2f, kLater_s = 3; // so far ahead it sees walls come
constexpr float kVisitRoom_m = 2.2f;          // a visit's time stands still where the film leaves less
constexpr float kWide_m = 2.6f;               // radius from which it begins the next approach

Shark spawnShark(const DiveFiles&, Random&); // at the beginning of a dive

// How far out its body fits as it swims along a circle, at the bearing of the place: at most the plan's
// radius.
float openRadius(glm::vec3 place, const SharkPlan&, const Species&, const FilmMoment&);

// What the shark knows of the dive.
struct SharkView {
    const DiveFile& dive;
    const SpeciesTable& species;
    const Hands& hands;
    std::span<const Fish> fish;
    float time_s;                               // since the dive began
    bool diveIsOver;                            // no new visits
    FilmMoment film{}, filmSoon{}, filmLater{}; // in kSoon_s, in kLater_s
};

// Before anybody sees it: where the film leaves room for it.
void startInRoom(Shark&, const SharkView&);

// Chooses what it does next.
void decide(Shark&, const SharkView&, Events&);

// Swims for a tick, as what it does demands.
void swimShark(Shark&, const SharkView&);

// At the end of a strike: takes the fish out of the hand, carries it off, loses it far out.
void bite(Shark&, const SharkView&, Hands&, std::span<Fish>, Score&, Events&);

// A hand that its body meets is bumped, and drops what it holds.
void bumpHands(Shark&, const SpeciesTable&, std::span<const physics::Contact>, Hands&, std::span<Fish>,
               Events&);

} // namespace shoal::game
