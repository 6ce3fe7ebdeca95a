// The one approximate description of a body: a few solid ellipsoids, each attached to one joint. Occlusion
// and shadows are derived from it. shoal-occlusion fits them (content/make/models/occlusion).
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace shoal::occlusion {

struct Ellipsoid {
    glm::vec3 centre{0};
    glm::mat3 worldFromAxes{1}; // columns: its axes, unit length
    glm::vec3 semiAxes{1};      // metres
};

struct BodyPart {
    Ellipsoid atRest; // in the frame of the mesh's positions
    uint16_t joint = 0;
};

} // namespace shoal::occlusion
