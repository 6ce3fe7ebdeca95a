// Source of live pictures: a camera, a pipe or a stream; in tests a fake.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/live/LiveAddress.h"

#include <cstdint>
#include <functional>
#include <string>

namespace shoal::media {

// Monotonic clock of arrivals, seconds.
double liveNow_s();

struct LivePicture {
    double arrived_s = 0; // by liveNow_s(): when its last byte was here, still coded
    double decode_ms = 0;
    int64_t passedOver = 0; // pictures since the last that were skipped because a newer one was there
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

} // namespace shoal::media
