// Fits a body's ellipsoids to its skin at rest.
#pragma once

#include "engine/occlusion/Ellipsoid.h"

#include <span>
#include <vector>

namespace shoal::occlusion {

// At rest. Views only.
struct RestBody {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const uint16_t> jointsOf; // which joint moves each position most
};

enum class Parts {
    ByJoint, // one for each joint that has any volume: for bodies that bend sharply
    ByShape, // by where the volume is: for bodies that bend softly
};

// At most `maximum`, the same for the same body. Empty for a body without volume or surface.
std::vector<BodyPart> fitEllipsoids(const RestBody& body, Parts parts, size_t maximum);

} // namespace shoal::occlusion
