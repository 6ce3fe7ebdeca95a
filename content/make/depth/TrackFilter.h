// Filters that turn estimates of single frames into a track: estimates have to agree with other frames, and
// to change steadily over time.
#pragma once

#include "content/make/depth/PairScale.h"
#include "engine/media/DepthTrack.h"

#include <span>

namespace shoal::depth {

struct OtherFrame {
    FramePose pose; // seen from the frame that is filtered, in its unit
    DepthEstimate depth;
};

// Lowers the confidence where other frames see something else in the same place; takes the mean where they
// see the same.
void requireAgreement(DepthEstimate& depth, std::span<const OtherFrame> others);

// Lowers the confidence beside texels of which nothing is known. As a rule the outline of something nearer
// lies there, and estimates reach over outlines by the width of the windows that are compared.
void doubtOutlines(DepthEstimate& depth);

// Writes the median of three neighbouring frames where all know something, which removes the errors of one.
// Inverse distances are in 1/m.
void medianOverTime(const DepthEstimate& before, const DepthEstimate& now, const DepthEstimate& after,
                    media::DepthFrame& out);

// Returns the share of the sphere, by solid angle, whose confidence is so high that depth is believed in full
// (content/README.md).
double believedShare(const media::DepthFrame& frame);

} // namespace shoal::depth
