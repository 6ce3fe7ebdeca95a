// Plane of the ground below the camera. Caustics and shadows move over the ground by themselves, so frames do
// not agree about it there; the ground seen around them, and in other frames, tells how far away it is.
#pragma once

#include "content/make/depth/StereoDepth.h"

#include <glm/vec3.hpp>

#include <span>

namespace shoal::depth {

struct Ground {
    glm::vec3 inverse{0}; // the inverse distance in a direction is its dot product with this
    float trust = 0;      // 0 to 1
};

// Number of track frames around a frame that its ground is found from together: two seconds of most films.
constexpr int kGroundFrames = 25;

// Fits the plane to the points below the horizon. Its trust rises with the share of the solid angle there
// that is known, in some of the frames, and falls with the points' distance from the plane. The maps have the
// size of FrameRecord.h.
Ground findGround(std::span<const DepthEstimate> frames);

// Writes the ground's distance into texels clearly below the horizon that are less sure than the ground. A
// thing that stands there and that no frame knows is lost in the ground.
void continueGround(const Ground& ground, DepthEstimate& depth);

} // namespace shoal::depth
