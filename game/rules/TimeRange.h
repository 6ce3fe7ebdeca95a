// A stretch of the dive's video, seconds from its start.
#pragma once

namespace shoal::game {

// How far a time of a video that repeats every videoLength_s lies within a stretch, 0 to 1: grows over the
// two seconds before it and fades over the two after it, beyond the video's end from its start on. 0 where
// the length is 0 (no video) or the stretch begins behind it (it belongs to a longer one).
double within(float from_s, float to_s, double videoLength_s, double time_s);

} // namespace shoal::game
