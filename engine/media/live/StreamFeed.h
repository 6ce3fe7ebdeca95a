// Streams and pipes: one thread reads what comes, so that nothing waits in the network, another decodes.
#pragma once

#include "engine/media/live/LiveFeed.h"

namespace shoal::media {

// address: not a camera.
LiveFeed streamFeed(const LiveAddress& address, const FeedPatience& patience);

} // namespace shoal::media
