// What a dive file marks in its video, by stretches in seconds from the video's start: how enclosed the place
// is, and where the ground is that shadows fall on.
//
// A mark's effect grows over the two seconds before it and fades over the two after it, beyond the video's
// end from its start on. Nothing is known where videoLength_s is 0 (no video) or where a mark begins behind
// the end (it belongs to a longer one).
#pragma once

#include <span>

namespace shoal::game {

struct Enclosure {
    float from_s = 0, to_s = 0;
    float amount = 1; // 0 open water to 1 a tunnel
};

// 0 to 1 at a time of a video that repeats every videoLength_s; where marks meet the greater counts.
float enclosureAt(std::span<const Enclosure> marks, double videoLength_s, double time_s);

// The ground about the viewer is as good as level.
struct GroundMark {
    float from_s = 0, to_s = 0;
    float height_m = -1.2f; // against the viewer's eyes
};

struct Ground {
    float height_m = 0;
    float presence = 0; // 0: none is known, and shadows fall nowhere; 1
};

// Where marks meet the height changes smoothly.
Ground groundAt(std::span<const GroundMark> marks, double videoLength_s, double time_s);

} // namespace shoal::game
