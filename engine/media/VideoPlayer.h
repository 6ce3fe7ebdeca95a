// Looping player of a video file, decoding ahead on a thread of its own.
//
// Time: frame i of the n frames is due from i / fps seconds on; after the last frame the first follows, and
// times keep growing ("unwrapped"): frame `index` shows picture `index % n`. Frames are evenly spaced, also
// in films of a variable rate: see VideoSource.
//
// Threads: all methods belong to one thread, the frame's. `prepare` runs on the decode thread. Memory: the
// slots, taken at open(), and that of FFmpeg's decoder.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/media/VideoFrame.h"

#include <string>

namespace shoal::media {

class VideoPlayer {
  public:
    // Returns when the first frame is ready. Fails if the file is not a regular one, not a video, larger than
    // kMaxVideoSide, or if its first frame cannot be decoded. Layout::Auto: see VideoSource::open().
    static Result<VideoPlayer> open(const Path& file, PlayerOptions options = {});

    const VideoInfo& info() const;

    // Returns the newest complete frame that is due, without waiting; if the decoder is late, an older one,
    // and the decoder skips frames to catch up. Small steps back in time (up to 0.5 s) keep the frame, larger
    // ones and jumps ahead seek. Never null. Valid until the next call of newest() or waitFor().
    const VideoFrame* newest(double videoTime_s);

    // Waits for exactly the frame due at this time, however far ahead or back, and returns it. The same times
    // give the same frames on every machine. If damage comes before that time, returns the last good frame.
    const VideoFrame* waitFor(double videoTime_s);

    // Returns a message for the user if something went wrong since the last call, else an empty one.
    std::string status();

  private:
    struct Impl;
    explicit VideoPlayer(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_; // its destructor ends the decode thread, after the frame in progress at most
};

} // namespace shoal::media
