// Plane of the ground below the camera. Where caustics and shadows move over the ground, frames give wrong
// distances; there the distance follows from the ground around these places, and from other frames.
#pragma once

#include "content/make/depth/StereoDepth.h"

#include <glm/vec3.hpp>

#include <span>

namespace shoal::depth {

struct Ground {
    glm::vec3 inverse{0}; // the inverse distance in a direction is its dot product with this
    float trust = 0;      // 0 to 1
};

// Number of neighbouring track frames from which a frame's ground is found: two seconds of most films.
constexpr int kGroundFrames = 25;

// Fits the plane to known texels well below the horizon. Its trust rises with the share of the solid angle
// there whose texels lie near the plane, and falls with these texels' distances from the plane. The maps have
// the size of FrameRecord.h.
Ground findGround(std::span<const DepthEstimate> frames);

// Writes the ground's distance into texels clearly below the horizon whose confidence is lower than the
// ground's. An object whose distance no frame knows is replaced by the ground behind it.
void continueGround(const Ground& ground, DepthEstimate& depth);

} // namespace shoal::depth
