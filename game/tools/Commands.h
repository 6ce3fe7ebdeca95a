// The commands of the program beside `shoal play`. Each returns its exit status and logs one sentence when it
// fails.
#pragma once

#include "game/settings/ToolOptions.h"

namespace shoal::app {

int view(const ViewOptions& options);
int light(const LightOptions& options);
int panorama(const PanoramaOptions& options);
int check(const CheckOptions& options);
int devices(const DevicesOptions& options);

} // namespace shoal::app
