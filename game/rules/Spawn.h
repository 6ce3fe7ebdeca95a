// Places fish and shark at the beginning of a dive.
#pragma once

#include "engine/core/Random.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Fish.h"
#include "game/rules/Shark.h"

#include <vector>

namespace shoal::game {

void spawnFish(const DiveFiles&, Random&, std::vector<Fish>& out);
Shark spawnShark(const DiveFiles&, Random&);

} // namespace shoal::game
