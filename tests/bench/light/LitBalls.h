// Balls of known reflectance in frames of the game's own films, whose true light is known: what is shown of
// them in the light that is made from the frame as it is coded, and in the true one.
#pragma once

#include "engine/core/Files.h"

#include <string>
#include <vector>

namespace shoal::bench {

// Root mean square difference of display values to those under the true light, 0 to 1, over a ball that is
// lit as each light::FrameRadiance has it.
struct BallErrors {
    std::string frame;
    std::vector<double> matte, glossy; // thesis, linear, auto
    // How much of the light on level ground the strongest light gives, so that its shadow takes as much: as
    // those three have it, and truly.
    std::vector<double> shadow;
};

struct LitBalls {
    std::vector<BallErrors> errors; // one for each of filmedSources()
};

// sheet: a JPEG of five frames, a row each: thesis, linear, auto, the true light; matte, then glossy.
Result<LitBalls> lightBalls(const Path& sheet);

// A table, its last row the medians over all frames.
std::string ballTable(const LitBalls& balls);

} // namespace shoal::bench
