// The settings that a player keeps between games, in $XDG_CONFIG_HOME/shoal/settings.json. The command line
// overrides them.
#pragma once

#include "engine/core/Result.h"
#include "game/settings/Setting.h"

namespace shoal::app {

// Sets what the file holds of the table's kept settings. A file that cannot be used is left alone, which is
// logged once; values of the wrong type or out of range are ignored.
void loadSettings(const SettingsTable& table);

// Writes the table's kept settings; the file is replaced as a whole or not at all.
Status saveSettings(const SettingsTable& table);

} // namespace shoal::app
