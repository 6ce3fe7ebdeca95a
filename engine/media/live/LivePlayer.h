// Sources of live pictures for `--video` (a camera, a named pipe or a URL; in tests a fake), and their
// player: it always shows the newest picture and never reads ahead. If nothing comes, the last picture stays,
// and the player connects again until pictures come.
#pragma once

#include "engine/media/VideoFrame.h"

#include <map>
#include <memory>
#include <optional>

namespace shoal::media {

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

    // Reads the newest picture that was not read before, as soon as there is one; blue first, sRGB-coded.
    // The image takes the picture's size, at most kMaxVideoSide a side. Sets the frame's light, chroma
    // texels, time of decoding, and arrival: that of the last coded byte, by liveNow_s(). Returns how many
    // pictures were skipped since the last one because a newer one had arrived. The error says why no more
    // come; then open() again.
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

// --- Player

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
    int64_t shown = 0;      // frames given out
    int64_t made = 0;       // frames decoded and prepared
    int64_t passedOver = 0; // skipped because a newer one was there
    int64_t stops = 0;      // times that nothing came for kStill_s
    int64_t losses = 0;     // times that the connection was lost
    int64_t resized = 0;    // times that the picture changed its size
};

class LivePlayer {
  public:
    // Returns when the first picture is ready. Fails if there is none, or none within firstPicture_s, or if
    // wait() returned false. wait: polled some twenty times a second; returns whether to go on waiting.
    static Result<LivePlayer> open(std::shared_ptr<LiveFeed> feed, LiveOptions options = {},
                                   const std::function<bool()>& wait = {});

    // Returns the newest complete frame; call it once per displayed frame. Never null. Valid until the next
    // call.
    const VideoFrame* newest();

    // Returns the last frame's latency in display frames, from arrival to display; 1: the next display frame.
    int displayFrames() const;

    // Returns the time since the last returned frame arrived.
    double age_s() const;

    LiveState state() const; // as of the last newest()

    // Returns a message for the user while nothing new comes, else an empty one. Valid until the next
    // newest().
    const std::string& notice() const;

    LiveCounts counts() const;

  private:
    struct Impl;
    using Owner = std::unique_ptr<Impl, std::function<void(Impl*)>>;
    explicit LivePlayer(Owner impl) : impl_(std::move(impl)) {}
    Owner impl_; // its deleter ends the thread; a feed that cannot be interrupted leaves it behind, detached
};

// Returns a description of a camera, pipe or stream for `shoal check`. Waits for its first picture, ten
// seconds at most. The error says why it cannot be played.
Result<std::string> checkLive(const LiveAddress& address);

} // namespace shoal::media
