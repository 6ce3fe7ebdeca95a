// Looping player of a video file, decoding ahead on a thread of its own.
//
// Time: frame i of the n frames is due from i / fps seconds on; after the last frame the first follows, and
// times keep growing ("unwrapped"): frame `index` shows picture `index % n`. Frames are evenly spaced at the
// container's mean rate, also those of a variable rate.
//
// Threads: newest(), waitFor(), status() and counts() belong to one thread, the frame's. `prepare` runs on
// the decode thread. Memory: the slots, taken at open(); nothing per frame by us (FFmpeg's decoder has its
// own).
//
// Not done here: sound; conversion of wide-gamut or HDR video.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/VideoInfo.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace shoal::media {

struct VideoFrame {
    ImageRgb8 pixelsBgr;   // sRGB-coded, BLUE first, as the decoder gives it; see VideoOptions::keepPixels
    int64_t index = -1;    // since the start of the first pass
    int64_t number = -1;   // within the video
    double pts_s = 0;      // when it is due: index / fps
    double decode_ms = 0;  // decoding and conversion of this frame alone
    double prepare_ms = 0; // of VideoOptions::prepare
};

struct VideoOptions {
    Layout layout = Layout::Auto;
    // One shown, the others ready or being filled. At least 3.
    int slots = 4;
    // Called on the decode thread for each frame that may be shown, after it lies in its slot; the caller
    // keeps what it makes per slot (0 .. slots - 1). Nobody else reads or writes that slot meanwhile, and it
    // stays untouched for as long as the frame is shown. Must not throw nor call the player.
    std::function<void(const VideoFrame& frame, int slot)> prepare;
    // False: only `prepare` sees pixelsBgr; in frames that are given out it is empty.
    bool keepPixels = true;
};

// Since open(), for statistics.
struct VideoCounts {
    int64_t shown = 0;   // frames given out
    int64_t made = 0;    // frames decoded and prepared
    int64_t skipped = 0; // frames decoded only because a later one was already due
    int64_t seeks = 0;   // jumps within the file, one for each new pass among them
};

class VideoPlayer {
  public:
    // Returns when the first frame is ready. Errors: as inspectVideo().
    static Result<VideoPlayer> open(const Path& file, VideoOptions options = {});

    VideoPlayer(VideoPlayer&&) noexcept;
    VideoPlayer& operator=(VideoPlayer&&) noexcept;
    ~VideoPlayer(); // ends the decode thread after at most the frame in work

    const VideoInfo& info() const;

    // The newest complete frame that is due at this time, without waiting. Where the decoder is late this is
    // an older one, and it skips frames to catch up. Small steps back in time (up to half a second) keep the
    // frame, larger ones and jumps ahead seek. Never null. Valid until the next call of newest() or
    // waitFor().
    const VideoFrame* newest(double videoTime_s);

    // Exactly the frame due at this time, however far ahead or back; waits for it. The same times give the
    // same frames on every machine. Where the file is damaged before that time: the last good frame.
    const VideoFrame* waitFor(double videoTime_s);

    // The slot of a frame of this player.
    int slotOf(const VideoFrame& frame) const;

    // A message for the user if something went wrong since the last call, else empty.
    std::string status();

    VideoCounts counts() const;

  private:
    struct Impl;
    explicit VideoPlayer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace shoal::media
