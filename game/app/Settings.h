// What a player has set, kept between games in $XDG_CONFIG_HOME/shoal/settings.json. The command line
// overrides it.
#pragma once

#include "engine/core/Result.h"

namespace shoal::app {

struct Settings {
    float volume = 0.8f;      // 0 to 1
    float hapticStrength = 1; // 0 (off) to 1
    bool headphones = false;
    bool captions = true;
    bool snow = true; // specks that drift in the water
};

// Defaults where there is no file. A file that cannot be used is left alone, and said so once in the log;
// values out of range are not believed.
Settings loadSettings();

// Written whole or not at all.
Status saveSettings(const Settings& settings);

} // namespace shoal::app
