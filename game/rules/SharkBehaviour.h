// Behaviour of the shark: it circles far out, visits, threatens and strikes at held fish; and how it swims.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

constexpr float kJaws_m = 0.28f;         // distance from mouth to fish at which the shark takes the fish
constexpr float kSharkEyeRoom_m = 0.55f; // least distance of its axis from the player's eyes in a strike...
constexpr float kSharkApart_m = 1.1f;    // ...and otherwise
constexpr float kStrikeTime_s = 2.5f;    // longest strike
constexpr float kFarOut_m = 0.6f;        // distance from its circle at which it has left and loses its prey
constexpr float kBumpRest_s = 2;         // time between two bumps
constexpr float kNotice_s = 1;           // time without bumps at the start of a visit
constexpr float kTempted = 4;            // Shark::interest above which it comes before a visit is due
constexpr float kStrikeFrom_m = 2.2f;    // greatest distance of a strike's start
constexpr float kAim_s = 0.7f;     // time for which it points at a hand, in full view, before it may strike
constexpr float kWarned_s = 1.2f;  // least time from the warning to the bite...
constexpr float kGrasped_s = 0.5f; // ...and from the grasp to the bite
constexpr float kScatter_m = 1.2f; // distance from its mouth at which fish flee when it threatens
constexpr float kAimed = 0.92f;    // cosine of the angle within which it points at a hand
constexpr float kThreat_s = 3.5f;  // longest threat
constexpr float kThreatRest_s = 4.0f;         // time between two threats
constexpr float kThreatFrom_m = 2.6f;         // greatest distance from mouth to hand for a threat
constexpr float kThreatRoom_m = 1.4f;         // least distance from mouth to hand in a threat...
constexpr float kThreatSpare_m = 0.6f;        // ...and how much more than that it wants at the start
constexpr float kSoon_s = 1.2f, kLater_s = 3; // look-ahead times for approaching walls
constexpr float kVisitRoom_m = 2.2f;          // open radius below which the visit's clock stops
constexpr float kWide_m = 2.6f;               // radius from which it begins the next approach

// Returns the largest circle radius, at most the plan's, at which the shark's body fits into the film's room
// at the bearing of the place, ahead_s from now.
float openRadius(glm::vec3 place, const DiveContext&, float ahead_s = 0);

// Places the shark where the film leaves room for it, before it is first seen.
void startInFreeSpace(Shark&, const DiveContext&);

// Chooses its state; a threat scatters the fish near it. Once the dive is over it begins no visit.
void decide(Shark&, std::span<Fish>, const DiveContext&, Random&, Events&);

// Swims for a tick as its state demands.
void swimShark(Shark&, const DiveContext&);

// Takes the prey out of the hand at the end of a strike, carries it off and loses it far out.
void bite(Shark&, Hands&, std::span<Fish>, Score&, const DiveContext&, Events&);

// Returns the place of the shark's mouth.
glm::vec3 mouthOf(const Shark&, const DiveContext&);

// Sends the shark off if it prowls or threatens, or if it strikes and a stone struck it. A fish in its mouth
// stays there.
void turnAway(Shark&, bool struck, const DiveContext&, Events&);

// Bumps the hands that its body meets; they drop what they hold.
void bumpHands(Shark&, std::span<const physics::Contact>, Hands&, std::span<Fish>, const DiveContext&,
               Events&);

} // namespace shoal::game
