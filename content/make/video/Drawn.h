// The picture and distances traced at one time, and the camera's position.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec3.hpp>

#include <vector>

namespace shoal::reef {

struct Drawn {
    ImageRgbF radianceLin;
    std::vector<float> distance; // metres, one for each pixel; reprojects the frame to nearby places
    glm::vec3 camera{0};
};

} // namespace shoal::reef
