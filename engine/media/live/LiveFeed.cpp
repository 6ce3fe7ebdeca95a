#include "engine/media/live/LiveFeed.h"

#include "engine/media/live/Camera.h"
#include "engine/media/live/StreamFeed.h"

namespace shoal::media {

LiveFeed feedFrom(const LiveAddress& address, const FeedPatience& patience) {
    if (const auto* camera = std::get_if<CameraAddress>(&address)) return cameraFeed(*camera);
    return streamFeed(address, patience);
}

} // namespace shoal::media
