// The commands of the program. Each returns its exit status and says on standard error, in one sentence, why
// it failed.
#pragma once

#include "game/app/Options.h"

namespace shoal::app {

int play(const PlayOptions& options);
int view(const ViewOptions& options);
int light(const LightOptions& options);
int panorama(const PanoramaOptions& options);
int check(const CheckOptions& options);
int devices(const DevicesOptions& options);

} // namespace shoal::app
