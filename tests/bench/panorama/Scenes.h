// Photos made by arithmetic, whose light and uprights are known.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec2.hpp>

namespace shoal::bench {

struct Scene {
    ImageRgb8 photo;
    glm::dvec2 light; // where its middle is, pixels
};

inline constexpr double kSceneFov_deg = 65; // horizontal

// A sun of two degrees over the sea, clipped, between wooden posts on a beach.
Scene beach(int width, int height);

// Between trunks, a clearing as a window of light.
Scene forest(int width, int height);

} // namespace shoal::bench
