// A LiveFeed is a source of live pictures for `--video`: a camera, a named pipe or a URL; in tests a fake.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace shoal::media {

struct VideoFrame;

struct LiveAddress {
    int camera = -1;   // of /dev/videoN; -1: a stream or a pipe
    std::string place; // a URL, or the file of a named pipe
    // Protocols that FFmpeg may use for it, comma separated: a server cannot redirect it to files.
    const char* protocols = "";
    bool isPipe = false;
};

// Parses "camera:N", the name of a named pipe, or a URL of a scheme that is played; empty for other text,
// such as a file's name. Fails for a malformed camera or URL, or a scheme that is not allowed.
Result<std::optional<LiveAddress>> liveAddress(const std::string& text);

// Returns the URL for messages: without user name and password.
std::string withoutPassword(const std::string& url);

// Monotonic clock of arrivals, seconds.
double liveNow_s();

class LiveFeed {
  public:
    LiveFeed(std::string shownName, const char* kindName) : name(std::move(shownName)), kind(kindName) {}
    virtual ~LiveFeed() = default;

    const std::string name; // as shown to the user
    const char* const kind; // "camera", "pipe", "stream"

    // open() and read() belong to one thread, and block.

    // Connects, or connects again. The error says why there is nothing to read.
    virtual Status open() = 0;

    // Reads the newest unread picture as soon as there is one, blue first, sRGB-coded; the image takes its
    // size, at most kMaxVideoSide a side. Sets the frame's light, chroma texels, decode_ms and arrived_s:
    // when its last coded byte came, by liveNow_s(). Returns how many it left out because a newer one had
    // arrived. The error says why no more pictures come; only open() can then bring new ones.
    virtual Result<int64_t> read(ImageRgb8& bgr, VideoFrame& frame) = 0;

    // Makes open() and read() return soon, now and later. Any thread.
    virtual void interrupt() = 0;
};

struct FeedTimeouts {
    double open_s = 10;   // time limit until there is something to read
    double silence_s = 4; // longest time between pictures, after which the connection counts as lost
};

// Makes a feed without opening it. A silent camera cannot be interrupted for ten seconds.
std::shared_ptr<LiveFeed> feedFrom(const LiveAddress& address, const FeedTimeouts& timeouts = {});

// Makes the feed of a pipe or a stream.
std::shared_ptr<LiveFeed> streamFeed(const LiveAddress& address, const FeedTimeouts& timeouts);

// Returns the names of the system's cameras by their numbers, without opening any.
std::map<int, std::string> listCameras();

} // namespace shoal::media
