// Quality of layered fragment buffers by their size: gaps, and errors in the picture of a body as a mirror.
#pragma once

#include "tests/bench/occlusion/Scene.h"

#include <string>
#include <vector>

namespace shoal::bench {

struct LayerQuality {
    std::string body, method;
    int views = 0, resolution = 0;
    size_t bytes = 0;
    double gaps = 0; // share of rays that hit where they should not, or the reverse
    double bounced[3] = {
        0, 0, 0}; // relative RMS of the mirror's picture: 1, 2, 8 bounces allowed, as the truth has them
    double ray_ns = 0, build_ms = 0;
};

// Measures the bodies that stand alone, by the thesis' method and the cured one, over views and resolutions.
std::vector<LayerQuality> measureLayers(std::span<const Scene> scenes, bool quick);

} // namespace shoal::bench
