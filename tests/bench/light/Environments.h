// The environments that the chart is measured over: panoramas that tests/bench/get_pictures fetched, the
// game's own video, and synthetic ones in which methods are known to fail.
#pragma once

#include "engine/light/FrameView.h"
#include "tests/bench/Bench.h"

namespace shoal::bench {

struct Environment {
    ImageRgb8 frame;       // red first; empty where the environment is linear
    ImageRgbF radianceLin; // full resolution; of a frame: by the thesis' inverse tone mapping of every texel

    bool coded() const { return !frame.empty(); }
    // Returns the width of the pyramid that baselines read: for a frame the one that the game uses, which is
    // enough for all of them.
    int baseWidth() const { return coded() ? 512 : 1024; }
    light::FrameView view() const {
        return {frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, false};
    }
};

// Loaded one at a time: some are 100 MB.
struct EnvironmentSource {
    std::string name;
    std::function<std::optional<Environment>()> load; // empty if its file is missing
};

// quick: only a few.
std::vector<EnvironmentSource> environmentSources(bool quick);

// Returns all pictures of high dynamic range, to measure the light that clipping loses; apartSources() first.
std::vector<EnvironmentSource> clippedSources();

// Returns the pictures that are known not to be among those that the constants of engine/light/ClippedLight.h
// were fitted to.
std::vector<EnvironmentSource> apartSources();

// Returns frames of the game's own video, with radianceLin holding the true light before the camera
// (content/truth). No other source has both.
std::vector<EnvironmentSource> filmedSources();

// Returns a 2048x1024 frame of the game's own video, for timing.
ImageRgb8 timedFrame();

// Returns whether a ten-thousandth of the sphere gives more than a twentieth of the light.
bool hasPointSun(const ImageRgbF& radianceLin);

} // namespace shoal::bench
