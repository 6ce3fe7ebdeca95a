// `shoal play`.
#pragma once

#include "game/settings/PlayOptions.h"

namespace shoal::app {

// Plays a dive until the player leaves or it ends by itself. Returns the exit status and logs one sentence
// when it fails.
int play(const PlayOptions& options);

} // namespace shoal::app
