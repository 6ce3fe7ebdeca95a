// Is this camera, pipe or stream usable, what is it, and if not, why not: for `shoal check`.
#pragma once

#include "engine/core/Result.h"
#include "engine/media/live/LiveAddress.h"

#include <string>

namespace shoal::media {

// Waits for its first picture, ten seconds at most.
Result<std::string> checkLive(const LiveAddress& address);

} // namespace shoal::media
