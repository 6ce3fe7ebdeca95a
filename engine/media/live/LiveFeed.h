// Sources of live pictures for `--video`: a camera, a named pipe or a URL; in tests a fake.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace shoal::media {

// Greatest size of a live picture: some 250 MB for the pictures that are decoded and shown at once.
constexpr int64_t kMaxLivePixels = int64_t{4096} * 4096;

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

struct LivePicture {
    double arrived_s = 0; // when its last coded byte arrived, by liveNow_s()
    double decode_ms = 0;
    int64_t passedOver = 0;     // pictures skipped since the last one because a newer one had arrived
    glm::ivec2 chromaTexels{2}; // as in VideoFrame
};

class LiveFeed {
  public:
    LiveFeed(std::string shownName, const char* kindName) : name(std::move(shownName)), kind(kindName) {}
    virtual ~LiveFeed() = default;

    const std::string name; // as shown to the user
    const char* const kind; // "camera", "pipe", "stream"

    // open() and read() belong to one thread, and block.

    // Connects, or connects again. The error says why there is nothing to read.
    virtual Status open() = 0;

    // Returns the newest picture that was not returned before, as soon as there is one; blue first,
    // sRGB-coded. The image takes the picture's size, at most kMaxVideoSide a side. The error says why no
    // more come; then open() again. radianceLin: as for VideoFrame.
    virtual Result<LivePicture> read(ImageRgb8& bgr, ImageRgbF& radianceLin) = 0;

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
