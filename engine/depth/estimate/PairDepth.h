// Distances of both frames of a pair, from the optical flow between them and the camera's movement.
#pragma once

#include "engine/depth/estimate/CubeFlow.h"
#include "engine/depth/estimate/FrameRecord.h"
#include "engine/depth/estimate/RelativePose.h"

namespace shoal::depth {

struct PairDepth {
    RelativePose pose;
    DepthEstimate first, second; // in units of the pair's baseline
};

// Once it is known that the camera moves. Where light glitters, few of the points that agree with the
// movement do so because they stand still, so that the sign tells less than isTranslation() asks for.
inline bool isUsable(const RelativePose& pose) {
    return pose.parallax_rad >= kMinParallax_rad && pose.agreement >= 0.25;
}

PairDepth estimatePair(CubeFlow& flow, const CubeFaces& first, const CubeFaces& second);

// Joins what the pair that begins at a frame and the one that ends there say, in the first's baseline, or
// where there is none, in the second's. Null: there is none.
FrameRecord joined(const PairDepth* begins, const PairDepth* ends);

} // namespace shoal::depth
