// Pictures of balls of known reflectance in frames of the game's own films, whose true light is known: in the
// light made from the coded frame, and in the true light.
#pragma once

#include "engine/core/Files.h"

#include <string>
#include <vector>

namespace shoal::bench {

// Root mean square differences from the display values under the true light, 0 to 1, over a ball lit by each
// light::FrameRadiance.
struct BallErrors {
    std::string frame;
    std::vector<double> matte, glossy; // thesis, linear, auto
    // Share of the light on level ground that comes from the strongest light, and that its shadow takes: by
    // those three, and by the true light.
    std::vector<double> shadow;
};

struct LitBalls {
    std::vector<BallErrors> errors; // one for each of filmedSources()
};

// sheet: a JPEG of five frames, a row each: thesis, linear, auto, the true light; matte, then glossy.
Result<LitBalls> lightBalls(const Path& sheet);

// Returns a table whose last row is the medians over all frames.
std::string ballTable(const LitBalls& balls);

} // namespace shoal::bench
