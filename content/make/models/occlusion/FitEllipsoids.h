// Fits a body's ellipsoids to its skin at rest.
#pragma once

#include "engine/occlusion/Ellipsoid.h"

#include <span>
#include <vector>

namespace shoal::occlusion {

// A body's surface at rest; views only.
struct RestBody {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const uint16_t> jointsOf; // by position: the joint that moves it most
};

enum class Parts {
    ByJoint, // one for each joint that has any volume: for bodies that bend sharply
    ByShape, // where the volume is: for bodies that bend softly
};

// Returns at most `maximum` ellipsoids, the same for the same body; none for one without volume or surface.
std::vector<BodyPart> fitEllipsoids(const RestBody& body, Parts parts, size_t maximum);

} // namespace shoal::occlusion
