// The ground that the video shows below the viewer: what shadows fall on.
#pragma once

#include <span>

namespace shoal::game {

// A stretch of the video, seconds from its start, in which the ground about the viewer is as good as level.
struct GroundMark {
    float from_s = 0, to_s = 0;
    float height_m = -1.2f; // against the viewer's eyes

    bool operator==(const GroundMark&) const = default;
};

struct Ground {
    float height_m = 0;
    float presence = 0; // 0: none is known, and shadows fall nowhere; 1
};

// At a time of a video that repeats every videoLength_s. Comes and goes with the marks over two seconds (see
// TimeRange.h); where marks meet its height changes as smoothly.
Ground groundAt(std::span<const GroundMark> marks, double videoLength_s, double time_s);

} // namespace shoal::game
