#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace shoal::occlusion {

struct Ellipsoid {
    glm::vec3 centre{0};
    glm::mat3 worldFromAxes{1}; // columns: its axes, unit length
    glm::vec3 semiAxes{1};      // metres
};

} // namespace shoal::occlusion
