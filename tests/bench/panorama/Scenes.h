// A synthetic photo in which the light and the upright lines are known.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec2.hpp>

namespace shoal::bench {

struct Scene {
    ImageRgb8 photo;
    glm::dvec2 light; // middle of the light, pixels
};

inline constexpr double kSceneFov_deg = 65; // horizontal

// Returns a forest with a bright clearing between trunks.
Scene forest(int width, int height);

} // namespace shoal::bench
