// Player of live video: always shows the newest picture and never reads ahead. If nothing comes, the last
// picture stays, and the player connects again until pictures come.
#pragma once

#include "engine/media/VideoFrame.h"
#include "engine/media/live/LiveFeed.h"

#include <memory>

namespace shoal::media {

struct LiveOptions : PlayerOptions { // layout: detected from shape or content, again when the size changes
    double firstPicture_s = 10;      // time limit of open()
    double retryFirst_s = 0.5, retryMax_s = 8; // delay before the next attempt: doubled after each failure
    std::function<double()> now_s = liveNow_s;
};

// Stopped: no new picture for kStill_s. Lost: the connection is lost, and attempts to restore it go on.
enum class LiveState { Playing, Stopped, Lost };
constexpr double kStill_s = 1;

// Counts since open(), for statistics.
struct LiveCounts {
    int64_t shown = 0;   // frames given out
    int64_t made = 0;    // frames decoded and prepared
    int64_t skipped = 0; // skipped because a newer one was there
    int64_t stops = 0;   // times that nothing came for kStill_s
    int64_t losses = 0;  // times that the connection was lost
    int64_t resized = 0; // times that the picture changed its size
};

class LivePlayer {
  public:
    // Returns when the first picture is ready. Fails if there is none, or none within firstPicture_s, or if
    // wait() returned false. wait: polled some twenty times a second; returns whether to go on waiting.
    static Result<LivePlayer> open(std::shared_ptr<LiveFeed> feed, LiveOptions options = {},
                                   const std::function<bool()>& wait = {});

    // Returns the newest complete frame: never null, valid until the next call. Call it once a display frame.
    const VideoFrame* newest();

    // Returns the last frame's latency in display frames, from arrival to display; 1: the next display frame.
    int displayFrames() const;

    // Returns the time since the last returned frame arrived.
    double age_s() const;

    LiveState state() const; // after the last call of newest()

    // Returns a message while nothing new comes, else an empty one. Valid until the next newest().
    const std::string& notice() const;

    LiveCounts counts() const;

  private:
    struct Impl;
    using Owner = std::unique_ptr<Impl, std::function<void(Impl*)>>;
    explicit LivePlayer(Owner impl) : impl_(std::move(impl)) {}
    Owner impl_; // its deleter stops the decode thread, or detaches it if the feed does not return
};

// Returns a description of a camera, pipe or stream for `shoal check`. Waits for its first picture, ten
// seconds at most. The error says why it cannot be played.
Result<std::string> checkLive(const LiveAddress& address);

} // namespace shoal::media
