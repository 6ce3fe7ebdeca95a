// The ground below the camera, taken for one plane. Caustics and shadows move over it by themselves, so
// frames do not agree about it there; what is seen of it around them, and in other frames, tells how far away
// it is.
#pragma once

#include "engine/depth/estimate/StereoDepth.h"

#include <glm/vec3.hpp>

#include <span>

namespace shoal::depth {

struct Ground {
    glm::vec3 inverse{0}; // the inverse distance in a direction is its dot product with this
    float trust = 0;      // 0 to 1
};

// Of a frame: so many frames of the track about it, two seconds of most films, tell of its ground together.
constexpr int kGroundFrames = 25;

// Trusted as far as enough of what lies below the horizon is known, in some of the frames, to lie near one
// plane, and evenly. The maps have the size of FrameRecord.h.
Ground findGround(std::span<const DepthEstimate> frames);

// Where too little is known, what is clearly below the horizon is the ground. Things that nothing is known of
// and that stand on it are lost in it.
void continueGround(const Ground& ground, DepthEstimate& depth);

} // namespace shoal::depth
