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
// Prints what each file is to standard output, or to standard error why it is not usable. Returns the exit
// status, 1 if there was such a file.
int check(const CheckOptions& options);
int devices(const DevicesOptions& options);

} // namespace shoal::app
