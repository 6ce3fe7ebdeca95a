// Sources of live pictures, as `--video` takes them: a camera, a named pipe or a URL; in tests a fake.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace shoal::media {

struct CameraAddress {
    int index = 0; // of /dev/videoN
};
struct PipeAddress {
    Path file;
};
// Live pictures have at most so many pixels: some 250 MB for those that are decoded and shown at once.
constexpr int64_t kMaxLivePixels = int64_t{4096} * 4096;

struct StreamAddress {
    std::string url;
    // Protocols that FFmpeg may use for it, comma separated: a server cannot redirect it to files.
    const char* protocols = "";
};
using LiveAddress = std::variant<CameraAddress, PipeAddress, StreamAddress>;

// "camera:N", the name of a named pipe, or a URL of a scheme that is played. Empty: `text` names a file, if
// anything. Errors: a malformed camera or URL, or a scheme that is not allowed.
Result<std::optional<LiveAddress>> liveAddress(const std::string& text);

// For messages: without user name and password.
std::string withoutPassword(const std::string& url);

// Monotonic clock of arrivals, seconds.
double liveNow_s();

struct LivePicture {
    double arrived_s = 0; // by liveNow_s(): when its last byte was here, still coded
    double decode_ms = 0;
    int64_t passedOver = 0;     // pictures since the last that were skipped because a newer one was there
    glm::ivec2 chromaTexels{2}; // as VideoFrame has them
};

struct LiveFeed {
    std::string name;      // as shown to the user
    const char* kind = ""; // "camera", "pipe", "stream"

    // open() and read() belong to one thread, and block.

    // Connects, or connects again. Errors: why there is nothing to read.
    std::function<Status()> open;

    // The newest picture that was not returned before, as soon as there is one; blue first, sRGB-coded. The
    // image takes the size of the picture, at most kMaxVideoSide a side. Errors: why no more come; then
    // open() again.
    std::function<Result<LivePicture>(ImageRgb8& bgr)> read;

    // From any thread: open() and read() return soon, from now on.
    std::function<void()> interrupt;
};

struct FeedTimeouts {
    double open_s = 10;   // until there is something to be read
    double silence_s = 4; // between pictures, before the connection counts as lost
};

// Does not open it yet.
LiveFeed feedFrom(const LiveAddress& address, const FeedTimeouts& timeouts = {});

// A pipe or a stream.
LiveFeed streamFeed(const LiveAddress& address, const FeedTimeouts& timeouts);

// A Video4Linux camera through OpenCV. Cannot be interrupted while it is silent: OpenCV waits ten seconds.
LiveFeed cameraFeed(const CameraAddress& address);

struct CameraListed {
    int index = 0;
    std::string name;
};
// As the system lists them; none is opened.
std::vector<CameraListed> listCameras();

} // namespace shoal::media
