// The ground below the camera, taken for one plane. Caustics and shadows move over it by themselves, so
// frames do not agree about it there; what is seen of it around them tells how far away it is.
#pragma once

#include "engine/depth/estimate/StereoDepth.h"

#include <glm/vec3.hpp>

#include <vector>

namespace shoal::depth {

struct Ground {
    glm::vec3 inverse{0}; // the inverse distance in a direction is its dot product with this
    float trust = 0;      // 0 to 1
};

// Trusted as far as enough of what lies below the horizon is known to lie near one plane, and evenly. The map
// has the size of FrameRecord.h.
Ground findGround(const DepthEstimate& depth);

// One for each frame of the track: means over a second, so that the ground neither flickers nor jumps.
std::vector<Ground> steadied(const std::vector<Ground>& grounds);

// Where too little is known, what is clearly below the horizon is the ground. Things that nothing is known of
// and that stand on it are lost in it.
void continueGround(const Ground& ground, DepthEstimate& depth);

} // namespace shoal::depth
