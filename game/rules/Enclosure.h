// How enclosed the place is that the video shows: open water, under an overhang, in a tunnel.
#pragma once

#include <span>

namespace shoal::game {

// A stretch of the video, seconds from its start.
struct Enclosure {
    float from_s = 0, to_s = 0;
    float amount = 1; // 0 open water to 1 a tunnel

    bool operator==(const Enclosure&) const = default;
};

// 0 to 1 at a time of a video that repeats every videoLength_s; nothing is known, and all is open, where that
// is 0. Grows over the two seconds before a mark and fades over the two after it, beyond the video's end from
// its start on; where marks meet the greater counts.
float enclosureAt(std::span<const Enclosure> marks, double videoLength_s, double time_s);

} // namespace shoal::game
