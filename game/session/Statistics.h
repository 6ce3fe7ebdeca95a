// Frame times, counts and the state hash of a session, as --stats writes them.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/media/live/LivePlayer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shoal::app {

// Milliseconds, in the order they came.
class Series {
  public:
    explicit Series(size_t reserve = 16384) { values_.reserve(reserve); }
    void add(double ms) { values_.push_back(static_cast<float>(ms)); }
    void clear() { values_.clear(); }
    size_t count() const { return values_.size(); }
    double quantile(double q) const; // 0 to 1; nearest rank; 0 when empty

  private:
    std::vector<float> values_;
};

// Latency of a live video: from the arrival of a frame's last byte until the picture that first shows it is
// drawn.
struct LiveStatistics {
    Series latency_ms, displayFrames; // see LivePlayer::displayFrames()
    media::LiveCounts counts;

    // fresh: this picture is the first to show its frame.
    void add(const media::LivePlayer& live, bool fresh);
};

// One line.
std::string describe(const LiveStatistics& live);

struct Statistics {
    LiveStatistics live;
    std::string renderer;
    Series frame_ms, light_ms, decode_ms, upload_ms; // the last three per frame of the video
    int draws = 0, triangles = 0;                    // of the last frame
    float minScale = 1; // of the picture's size that it was drawn at, see DynamicQuality.h
    int caught = 0, score = 0;
    uint64_t stateHash = 0, ticks = 0;
};

// Maximum resident memory of this process so far, MiB.
double peakResident_MiB();

Status writeStatistics(const Path& file, const Statistics& statistics);

} // namespace shoal::app
