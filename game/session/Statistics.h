// Statistics hold a session's frame times, counts and state hash, for the developer's panel and for --stats.
#pragma once

#include "engine/media/live/LivePlayer.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace shoal::app {

struct Series : std::vector<float> { // in the order of arrival
    Series() { reserve(16384); }     // so that no frame allocates
};

struct Statistics {
    std::string renderer;
    Series frame_ms; // without the first frame
    std::vector<std::pair<const char*, Series>>
        parts; // time of each part of a frame (engine/gl/PassTimers.h), as frame_ms
    Series light_ms, decode_ms, upload_ms; // per frame of the video
    // Latency of a live video, from the arrival of a frame's last byte until the picture that first shows it
    // is drawn; and LivePlayer::displayFrames().
    Series liveLatency_ms, liveDisplayFrames;
    media::LiveCounts live;
    float sim_ms = 0; // of the last frame, as are draws and triangles
    int draws = 0, triangles = 0;
    float minScale = 1; // least Quality::scale, see DynamicQuality.h
    int caught = 0, score = 0;
    uint64_t stateHash = 0, ticks = 0;
    std::string summary; // GameSession::summary

    // Adds the time of a part of the frame that is measured, before its frame_ms.
    void addPart(const char* part, float ms) {
        auto known = std::ranges::find(parts, part, &decltype(parts)::value_type::first);
        if (known == parts.end()) known = parts.insert(known, {part, {}});
        known->second.resize(frame_ms.size(), 0); // frames before the part's first
        known->second.push_back(ms);
    }
};

} // namespace shoal::app
