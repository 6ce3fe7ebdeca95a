// What makes estimates of single frames a track: they have to agree with those of other frames, and change
// steadily over time.
#pragma once

#include "engine/depth/estimate/PairScale.h"
#include "engine/media/DepthTrack.h"

#include <span>

namespace shoal::depth {

struct OtherFrame {
    FramePose pose; // seen from the frame in question, in its unit
    DepthEstimate depth;
};

// Confidence falls where other frames see something else in the same place; where they see the same the mean
// is taken.
void requireAgreement(DepthEstimate& depth, std::span<const OtherFrame> others);

// Beside a texel of which nothing is known lies, as a rule, the outline of something before it, and estimates
// reach over outlines by the windows that are compared: less is believed there.
void doubtOutlines(DepthEstimate& depth);

// The median of three neighbouring frames where all know something: what one of them got wrong goes. 1/m.
void medianOverTime(const DepthEstimate& before, const DepthEstimate& now, const DepthEstimate& after,
                    media::DepthFrame& out);

// Of solid angle: what is of a confidence from which on all is believed (content/README.md).
double believedShare(const media::DepthFrame& frame);

} // namespace shoal::depth
