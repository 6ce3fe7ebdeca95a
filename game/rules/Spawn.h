// Fish and shark as a dive begins.
#pragma once

#include "engine/core/Random.h"
#include "game/rules/Creatures.h"

#include <vector>

namespace shoal::game {

void spawnFish(const DiveFiles&, Random&, std::vector<Fish>& out);
Shark spawnShark(const DiveFiles&, Random&);

} // namespace shoal::game
