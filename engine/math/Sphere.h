// A sphere, metres.
#pragma once

#include <glm/vec3.hpp>

namespace shoal {

struct Sphere {
    glm::vec3 centre{0};
    float radius = 0;
};

} // namespace shoal
