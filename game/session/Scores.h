// Best score of each dive, kept between games in $XDG_DATA_HOME/shoal/scores.json.
#pragma once

#include "engine/core/Result.h"

#include <string>

namespace shoal::app {

// 0 if there is none yet, or the file cannot be used (which is logged, and the file left as it is).
int bestScore(const std::string& dive);

// Written whole or not at all. Keeps the other dives' scores.
Status saveBestScore(const std::string& dive, int score);

} // namespace shoal::app
