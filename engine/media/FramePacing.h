// Choice of the frame that a film's decoder makes next, so that what is shown follows a clock. Internal to
// this folder. Times are in frames of the film: a cost of 1 is real time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace shoal::media {

// Cost of recent pictures.
struct DecodingCost {
    double decode = 0; // of each picture
    double show = 0;   // besides, of one that is shown: conversion and analysis

    // Follows the costs of a frame, for which `count` pictures were decoded in all.
    void follow(int64_t count, double decoding, double showing) {
        constexpr double kShare = 0.25; // of the newest costs
        decode += kShare * (decoding / static_cast<double>(count) - decode);
        show += kShare * (showing - show);
    }
};

struct NextFrame {
    int64_t index = 0;
    bool hurries = false; // pictures that no others refer to are left out meanwhile
};

// Returns the frame to make after frame `made`, while frame `due` is due: the next one; or one further on, so
// that it is ready while it is due although all pictures before it are decoded too. If decoding these takes
// more than `longest`, the film falls behind by small steps, until a key frame can be made in time:
// keyFrameBefore(index) is the last one at or before a frame.
template <class KeyFrameBefore>
NextFrame nextFrame(int64_t made, int64_t due, const DecodingCost& cost, double longest,
                    KeyFrameBefore&& keyFrameBefore) {
    // A frame is due for a time of 1. n frames on, n cost.decode + cost.show pass: due + that = made + n + 1.
    const double late = static_cast<double>(due - made - 1) + cost.show;
    if (late <= 0) return {made + 1};
    const double step = std::ceil(late / (1 - cost.decode));
    if (cost.decode < 1 && step * cost.decode <= longest) return {made + static_cast<int64_t>(step)};
    // Such a step leaves four fifths of the time to decoding, or some picture to leave out.
    const double most = std::max(longest / cost.decode, 1.0);
    const auto small = static_cast<int64_t>(std::min(std::max(4 * cost.show / cost.decode, 2.0), most));
    const auto ready = due + static_cast<int64_t>(cost.decode + cost.show);
    return {std::max(made + small, keyFrameBefore(ready)), true};
}

} // namespace shoal::media
