// The commands of the program.
#pragma once

#include "engine/core/Result.h"
#include "game/settings/PlayOptions.h"
#include "game/settings/ToolOptions.h"

namespace shoal::app {

// Plays a dive until the player leaves or it ends by itself.
Status play(const PlayOptions& options);
Status view(const ViewOptions& options);
Status light(const LightOptions& options);
Status panorama(const PanoramaOptions& options);
// Prints a line for each file: "usable: FILE: KIND" to standard output, or "not usable: FILE: REASON" to
// standard error. Returns the exit status, 1 if a file is not usable.
int check(const CheckOptions& options);
int devices(const DevicesOptions& options);

} // namespace shoal::app
