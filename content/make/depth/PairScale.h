// Baselines of all pairs of a film on one scale, and poses along the chain of pairs.
#pragma once

#include "content/make/depth/FrameRecord.h"

#include <optional>
#include <vector>

namespace shoal::depth {

// Removes poses whose direction of movement is far from most around them, and fills gaps of a few frames with
// the nearest pose.
void repairMotion(std::vector<PairMotion>& motions);

// Returns the baseline of each pair, on one scale; their geometric mean is 1, since the film's true scale is
// not known. Pair t begins where pair t - step ends, and the ratio of both baselines is known; pairs t and
// t + 1 nearly coincide, so their baselines differ little. The equations are solved by least squares of
// logarithms, in which outlying ratios count little.
std::vector<double> linkBaselines(const std::vector<PairMotion>& motions, int step);

// Pose of another frame seen from a reference frame.
struct FramePose {
    glm::dmat3 fromReference{1}; // rotation of directions, from the reference frame's axes to the other's
    glm::dvec3 at{0};            // the other's camera, in the reference frame's axes
};

// Returns the pose of the frame that is `pairs` pairs ahead of frame t, or behind it if negative; empty if
// the chain is broken between them.
std::optional<FramePose> poseAlongChain(const std::vector<PairMotion>& motions,
                                        const std::vector<double>& baselines, int t, int pairs, int step);

} // namespace shoal::depth
