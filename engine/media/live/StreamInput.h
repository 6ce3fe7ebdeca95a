// Reader of a stream's or pipe's video packets. Internal to this folder; used by one thread but for the last
// two methods.
#pragma once

#include "engine/media/Ffmpeg.h"
#include "engine/media/live/LiveFeed.h"
#include "engine/media/live/PipeInput.h"

#include <atomic>
#include <memory>
#include <optional>

namespace shoal::media {

class StreamInput {
  public:
    StreamInput(const LiveAddress& address, const FeedTimeouts& timeouts);
    ~StreamInput();
    StreamInput(const StreamInput&) = delete;
    StreamInput& operator=(const StreamInput&) = delete;

    // Connects, or connects again.
    Status open();

    const AVStream& video() const; // once open
    // A file on a server, of known length: it sends as fast as it is read.
    bool stored() const { return stored_; }
    // Whether time stamps are the sender's, and not invented by FFmpeg.
    bool stamped() const { return stamped_; }

    // Blocks until the next video packet. Error: why there is none.
    Status read(AVPacket& packet);

    // From any thread: open() and read() return soon; until the next open(), or for good.
    void stop() { stopped_ = true; }
    void interrupt() { interrupted_ = true; }

  private:
    bool givesUp() const;
    Status openFormat();
    void passPacketsUnparsed();
    void markKeyFrame(AVPacket& packet);

    LiveAddress address_;
    FeedTimeouts timeouts_;
    std::optional<PipeInput> pipe_;
    Input format_;
    int stream_ = -1;
    bool unparsed_ = false; // each packet is one picture
    std::unique_ptr<AVCodecParserContext, CloseParser> parser_;
    Codec parsed_;
    bool stored_ = false, stamped_ = true;
    double deadline_s_ = 0;
    std::atomic<bool> stopped_{false}, interrupted_{false};
};

} // namespace shoal::media
