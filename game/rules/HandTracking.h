// Takes the player's head and hands of a tick into the state of a dive.
#pragma once

#include "game/rules/Hand.h"

namespace shoal::game {

// Updates view and hands from the tick's input. Values that are not finite or not plausible are ignored: the
// last good ones stay.
void trackHands(const TickInput&, Viewpoint&, Hands&);

} // namespace shoal::game
