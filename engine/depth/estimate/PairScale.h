// The baselines of the pairs of a film on one scale, and their chain of poses.
#pragma once

#include "engine/depth/estimate/FrameRecord.h"

#include <optional>
#include <vector>

namespace shoal::depth {

// Takes poses away whose direction of movement is far from that of most around them, and fills gaps of a few
// frames with the nearest pose.
void repairMotion(std::vector<PairMotion>& motions);

// The baseline of each pair, on one scale of which nothing is known but that its geometric mean is 1. Pair t
// goes on where pair t - step ends, and their ratio is known; neighbours overlap nearly wholly, so that their
// baselines differ little. Least squares in logarithms, ratios that are far off count little.
std::vector<double> linkBaselines(const std::vector<PairMotion>& motions, int step);

// Of a frame seen from another: rotation of directions from this one to that one, and where that one's camera
// is, in this one's axes.
struct FramePose {
    glm::dmat3 fromReference{1};
    glm::dvec3 at{0};
};

// `pairs` pairs ahead of frame t, or back where it is negative. Nothing: the chain is broken between them.
std::optional<FramePose> poseAlongChain(const std::vector<PairMotion>& motions,
                                        const std::vector<double>& baselines, int t, int pairs, int step);

} // namespace shoal::depth
