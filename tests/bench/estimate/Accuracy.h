// Accuracy of an estimated depth track against the true one.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <vector>

namespace shoal::bench {

// Shares are of solid angle.
struct FrameAccuracy {
    double time_s = 0;    // of the film
    double right = 0;     // share of confident texels within 10 % of the truth, after one factor for the film
    double rightOwn = 0;  // the same after a factor of the frame's own
    double covered = 0;   // share of texels nearer than 10 m that are confident
    double ownFactor = 1; // median of estimated over true distances, over that of the film
};

struct Accuracy {
    double factor = 1; // median of estimated over true distances
    std::vector<FrameAccuracy> frames;
};

// The film begins at from_s of the truth, which may be longer.
Result<Accuracy> accuracyOf(const Path& estimated, const Path& truth, double from_s);

} // namespace shoal::bench
