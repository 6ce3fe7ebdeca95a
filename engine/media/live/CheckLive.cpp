#include "engine/media/live/CheckLive.h"

#include "engine/media/live/LivePlayer.h"

namespace shoal::media {

Result<std::string> checkLive(const LiveAddress& address) {
    LiveFeed feed = feedFrom(address);
    const std::string kind = feed.kind;
    auto player = LivePlayer::open(std::move(feed));
    if (!player) return player.error();
    const LiveFrame& frame = *player->newest();
    return "a live " + kind + " of " + std::to_string(frame.pixelsBgr.width) + "x" +
           std::to_string(frame.pixelsBgr.height) + ", lat-long " + nameOf(frame.layout);
}

} // namespace shoal::media
