// Where live pictures come from: a camera, a pipe, a stream; in tests something made up.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/live/LiveAddress.h"

#include <cstdint>
#include <functional>
#include <string>

namespace shoal::media {

// The clock of arrivals: seconds that never go back.
double liveNow_s();

struct LivePicture {
    double arrived_s = 0; // by liveNow_s(): when its last byte was here, still coded
    double decode_ms = 0;
    int64_t passedOver =
        0; // pictures that came since the last, and were not given out: a newer one was there
};

struct LiveFeed {
    std::string name;      // as shown to the person
    const char* kind = ""; // "camera", "pipe", "stream"

    // open() and read() belong to one thread, and block.

    // Begins, or begins anew whatever was before. Errors: why there is nothing to be read.
    std::function<Status()> open;

    // The newest picture, as soon as there is one that was not given out before; blue first, sRGB-coded. The
    // image takes the size of the picture: at most kMaxVideoSide a side. Errors: why no more come; then
    // open() again.
    std::function<Result<LivePicture>(ImageRgb8& bgr)> read;

    // From any thread: open() and read() return soon, now and for ever after.
    std::function<void()> interrupt;
};

struct FeedPatience {
    double open_s = 10;   // until there is something to be read
    double silence_s = 4; // between pictures, before the connection counts as lost
};

// Does not open it yet.
LiveFeed feedFrom(const LiveAddress& address, const FeedPatience& patience = {});

} // namespace shoal::media
