// The reason why a closing hand takes nothing.
#pragma once

#include "game/rules/DiveState.h"
#include "game/rules/Events.h"

#include <span>

namespace shoal::game {

constexpr float kFastHand_mps = 1.2f;

// Returns why a hand whose grip has just closed would take nothing. The intended fish is the one nearest to
// the line of sight from the eyes through the grasp centre:
//   Nothing   no fish is near the line;
//   TooFast   the hand was faster than kFastHand_mps while it closed, or the fish flees;
//   TooFar    the fish is farther along the line than the fingers reach;
//   Behind    it is on the near side of the hand, or beside it and swimming away: the hand came from behind;
//   TooEarly  it is beside the hand and not yet there.
Miss missOf(const Hand&, std::span<const Fish>, const DiveContext&);

EventKind eventOf(Miss);

} // namespace shoal::game
