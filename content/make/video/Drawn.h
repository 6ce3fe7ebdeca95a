// The picture, distances and motion traced at one time.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec3.hpp>

#include <vector>

namespace shoal::reef {

struct Drawn {
    ImageRgbF radianceLin;
    std::vector<float> distance; // metres, a pixel each: with it the frame is seen from a little beside
    glm::vec3 camera{0};
};

} // namespace shoal::reef
