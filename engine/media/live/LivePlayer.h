// Player of live video: always the newest picture, never reading ahead. Where nothing comes, the last picture
// stays, and the connection is made again until pictures come.
//
// Threads: all methods belong to one thread, the frame's. `prepare` runs on the decode thread. Memory: the
// slots, allocated when pictures first come and when they change their size. A frame that was not shown
// before the next was complete is never shown.
#pragma once

#include "engine/media/VideoFrame.h"
#include "engine/media/live/LiveFeed.h"

#include <memory>

namespace shoal::media {

struct LiveOptions
    : PlayerOptions {           // layout: from the picture's shape or content, anew when its size changes
    double firstPicture_s = 10; // time limit of open()
    double retryFirst_s = 0.5, retryMax_s = 8; // delay before the next attempt: doubled after each failure
    std::function<double()> now_s = liveNow_s;
};

// Stopped: without a new picture for kStill_s.
enum class LiveState { Playing, Stopped, Lost };
constexpr double kStill_s = 1;

// Since open(), for statistics.
struct LiveCounts {
    int64_t shown = 0;      // frames given out
    int64_t made = 0;       // frames decoded and prepared
    int64_t passedOver = 0; // skipped because a newer one was there
    int64_t stops = 0;      // times that nothing came for kStill_s
    int64_t losses = 0;     // times that the connection was lost
    int64_t resized = 0;    // times that the picture changed its size
};

class LivePlayer {
  public:
    // Returns when the first picture is ready. Errors: why there is none, or none within firstPicture_s, or
    // wait() returned false. wait: polled some twenty times a second; whether to go on waiting.
    static Result<LivePlayer> open(LiveFeed feed, LiveOptions options = {},
                                   const std::function<bool()>& wait = {});

    LivePlayer(LivePlayer&&) noexcept;
    LivePlayer& operator=(LivePlayer&&) noexcept;
    // Returns soon, whatever the feed is waiting for: a feed that cannot be interrupted leaves its thread
    // behind, detached and sharing nothing with us.
    ~LivePlayer();

    // To be called once per displayed frame: the newest complete frame. Never null. Valid until the next
    // call.
    const VideoFrame* newest();

    // Display frames between the arrival of the frame last returned and its display: 1 if the next showed it.
    int displayFrames() const;

    // Time since the frame last returned had arrived.
    double age_s() const;

    LiveState state() const; // as of the last newest()

    // A message for the user while nothing new comes, else empty. Valid until the next newest().
    const std::string& notice() const;

    LiveCounts counts() const;

  private:
    struct Impl;
    explicit LivePlayer(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;
};

// A description of a camera, pipe or stream for `shoal check`. Waits for its first picture, ten seconds at
// most. Error: why it cannot be played.
Result<std::string> checkLive(const LiveAddress& address);

} // namespace shoal::media
