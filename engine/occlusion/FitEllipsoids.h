// A skinned body as a few solid ellipsoids, each riding on one joint.
#pragma once

#include "engine/occlusion/Ellipsoid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

// At rest. Views only.
struct RestBody {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const uint16_t> jointsOf; // which joint moves each position most
};

struct BodyPart {
    Ellipsoid atRest; // in the frame of the positions
    uint16_t joint = 0;
    float share = 0; // of the body's volume
};

enum class Parts {
    ByJoint, // a limb for each joint that has any volume: what bends sharply
    ByShape, // where the volume is: what bends softly
};

// At most `most`, the same for the same body. Empty for a body without volume or surface.
std::vector<BodyPart> fitEllipsoids(const RestBody& body, Parts parts, size_t most);

} // namespace shoal::occlusion
