// What a player keeps between games: settings, in $XDG_CONFIG_HOME/shoal/settings.json, which the command
// line overrides, and best scores, in $XDG_DATA_HOME/shoal/scores.json. A file that cannot be used is left
// alone.
#pragma once

#include "engine/core/Result.h"
#include "game/settings/Setting.h"

namespace shoal::app {

// Sets what the file holds of the table's kept settings; values of the wrong type or out of range are
// ignored.
void loadSettings(const SettingsTable& table);

// Writes the table's kept settings; the file is replaced as a whole or not at all.
Status saveSettings(const SettingsTable& table);

// 0 if there is none yet, or the file cannot be used (which is logged, and the file left as it is).
int bestScore(const std::string& dive);

// Written whole or not at all. Keeps the other dives' scores.
Status saveBestScore(const std::string& dive, int score);

} // namespace shoal::app
