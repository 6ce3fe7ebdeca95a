// The environments that the chart is measured over: real ones where the reference data is at hand, the game's
// own video, and made ones at which methods are known to fail.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shoal::bench {

struct Environment {
    std::string name;
    ImageRgb8 frame; // red first; empty where the environment is linear
    ImageRgbF
        radianceLin; // full resolution; of a frame: every texel through the thesis' inverse tone mapping

    bool coded() const { return !frame.empty(); }
    // Width of the pyramid that baselines read: for a frame as the game asks for, no more than any of them
    // needs.
    int baseWidth() const { return coded() ? 512 : 1024; }
    light::FrameView view() const {
        return {frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, false};
    }
};

// Loaded one at a time: some are 100 MB.
struct EnvironmentSource {
    std::string name;
    std::function<std::optional<Environment>()> load; // nothing where its file is not at hand
};

// shared: the folder of reference data, which may be missing. quick: only a few, none larger than 1024x512.
std::vector<EnvironmentSource> environmentSources(const Path& shared, bool quick);

// The six pictures of high dynamic range alone.
std::vector<EnvironmentSource> hdrSources(const Path& shared);

// These and the two under data/fidelity: for what clipping takes away.
std::vector<EnvironmentSource> clippedSources(const Path& shared);

// Frames of the game's own video, and in radianceLin the light that they were filmed in, from before the
// camera (content/truth): nowhere else are both known.
std::vector<EnvironmentSource> filmedSources();

// A 2048x1024 frame of the game's own video, for timing.
ImageRgb8 timedFrame();

// Whether a ten-thousandth of the sphere gives more than a twentieth of the light.
bool hasPointSun(const ImageRgbF& radianceLin);

} // namespace shoal::bench
