// The one approximate description of a body: a few solid ellipsoids, each attached to one joint. Occlusion
// and shadows are derived from it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

struct Ellipsoid {
    glm::vec3 centre{0};
    glm::mat3 worldFromAxes{1}; // columns: its axes, unit length
    glm::vec3 semiAxes{1};      // metres
};

// At rest. Views only.
struct RestBody {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const uint16_t> jointsOf; // which joint moves each position most
};

struct BodyPart {
    Ellipsoid atRest; // in the frame of the positions
    uint16_t joint = 0;
};

enum class Parts {
    ByJoint, // one for each joint that has any volume: for bodies that bend sharply
    ByShape, // by where the volume is: for bodies that bend softly
};

// At most `maximum`, the same for the same body. Empty for a body without volume or surface.
std::vector<BodyPart> fitEllipsoids(const RestBody& body, Parts parts, size_t maximum);

} // namespace shoal::occlusion
