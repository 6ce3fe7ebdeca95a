// A stream's or a pipe's packets, as they come. Internal to this folder; one thread's, but for the last two.
#pragma once

#include "engine/media/Ffmpeg.h"
#include "engine/media/live/LiveFeed.h"
#include "engine/media/live/PipeInput.h"

#include <atomic>
#include <memory>
#include <optional>

struct AVFormatContext;
struct AVStream;

namespace shoal::media {

class StreamInput {
  public:
    StreamInput(const LiveAddress& address, const FeedPatience& patience);
    ~StreamInput();
    StreamInput(const StreamInput&) = delete;
    StreamInput& operator=(const StreamInput&) = delete;

    // Anew, whatever was before.
    Status open();

    const AVStream& picture() const; // the stream of pictures, once open
    // It is of a length that is known: a file on a server. It gives as much as is read.
    bool stored() const { return stored_; }
    // Whether time stamps are the sender's, and not made up on the way.
    bool stamped() const { return stamped_; }

    // Blocks until the next packet of the pictures. Error: why there is none.
    Status read(AVPacket& packet);

    // From any thread: open() and read() return soon; until the next open(), or for good.
    void leave() { left_ = true; }
    void interrupt() { interrupted_ = true; }

  private:
    bool givesUp() const;
    void giveWholePictures();
    void tellKey(AVPacket& packet);
    void close();

    LiveAddress address_;
    FeedPatience patience_;
    std::optional<PipeInput> pipe_;
    AVFormatContext* format_ = nullptr;
    int stream_ = -1;
    bool whole_ = false; // packets are pictures as they come
    std::unique_ptr<AVCodecParserContext, CloseParser> parser_;
    Codec parsed_;
    bool stored_ = false, stamped_ = true;
    double until_s_ = 0; // when to give up
    std::atomic<bool> left_{false}, interrupted_{false};
};

} // namespace shoal::media
