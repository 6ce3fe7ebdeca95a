// Fish come to look at a hand that rests, open and in the player's view, one or two at a time: they swim to
// about a hand's width before the palm, linger and leave. So fish that are out of reach come within it, and
// waiting works. A fast or closing hand ends a visit.
#pragma once

#include "game/rules/DiveState.h"

#include <span>

namespace shoal::game {

// Begins and ends visits; called every tick.
void chooseVisitors(Hands&, std::span<Fish>, const DiveContext&, Random&);

// Returns the place in front of the palm that a visiting fish swims to.
glm::vec3 visitedPlace(const Hand&);

constexpr float kVisitSlow_m = 0.25f; // distance from that place below which it slows down

} // namespace shoal::game
