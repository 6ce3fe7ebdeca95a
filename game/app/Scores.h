// The best score of each dive, kept between games.
#pragma once

#include "engine/core/Result.h"

#include <string>

namespace shoal::app {

// 0 if there is none yet, or the file cannot be used (which is said once in the log, and the file left
// alone).
int bestScore(const std::string& dive);

// Written whole or not at all. Keeps the other dives' scores.
Status saveBestScore(const std::string& dive, int score);

} // namespace shoal::app
