// Distances in both frames of a pair, from the optical flow between them and the camera's movement.
#pragma once

#include "content/make/depth/CubeFlow.h"
#include "content/make/depth/FrameRecord.h"
#include "content/make/depth/RelativePose.h"

namespace shoal::depth {

struct PairDepth {
    RelativePose pose;
    DepthEstimate first, second; // in units of the pair's baseline
};

// Returns true if distances can be found from the pose, in a film whose camera is known to move. It requires
// less agreement than isTranslation(): where light glitters, points move by themselves, and more of them seem
// to lie behind the camera.
inline bool isUsable(const RelativePose& pose) {
    return pose.parallax_rad >= kMinParallax_rad && pose.agreement >= 0.25;
}

PairDepth estimatePair(CubeFlow& flow, const CubeFaces& first, const CubeFaces& second);

// Joins the distances of the pair that begins at a frame and of the pair that ends there, in baselines of the
// first or, if there is no first, of the second. Either may be null.
FrameRecord joined(const PairDepth* begins, const PairDepth* ends);

} // namespace shoal::depth
