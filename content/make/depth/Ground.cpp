#include "content/make/depth/Ground.h"

#include "content/make/depth/FrameRecord.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::depth {

namespace {

constexpr float kKnown = 0.5f;    // minimum confidence of an estimate that is used
constexpr float kLowest = -0.26f; // sine of the highest elevation that is looked at: 15 degrees down
// The fit begins at this quantile of inverse heights, below the median, because rock is nearer than ground.
constexpr double kFirstQuantile = 0.4;
constexpr int kRounds = 8;
constexpr float kTolerance = 0.25f; // relative error of distance from which on a texel has no weight
constexpr float kOnGround = 0.12f;  // relative error up to which a texel is part of the ground
constexpr int kMinTimes = 2;        // least number of frames in which a texel's distance is known
// Share of the solid angle looked at that is known to be ground: the plane has no trust at the first, full
// trust at the second. Films that have ground show 0.23 to 0.98; other shapes were taken for ground over 0.02
// to 0.19 (tests/bench/depth_estimate).
constexpr float kMinSeen = 0.15f, kEnoughSeen = 0.2f;
// Root mean square of the relative error on the ground: 0.01 to 0.051 for real ground, 0.054 to 0.07 for
// other shapes.
constexpr float kFlat = 0.05f, kUneven = 0.056f;
// Sine of the smallest angle to the plane at which it is filled: 12 degrees. Rocks hide the ground beyond.
constexpr float kFilledAngle = 0.21f;
constexpr float kFilled = 0.7f; // confidence of filled texels, at full trust

struct Seen {
    glm::vec3 dir;
    float inverse, area; // 1/m; steradians
};

// Fits the plane by weighted least squares; weights follow from the round before (Tukey's biweight).
glm::vec3 fittedTo(const std::vector<Seen>& seen) {
    std::vector<float> heights;
    for (const Seen& each : seen) heights.push_back(each.inverse / -each.dir.y);
    glm::vec3 plane(0, -math::quantile(heights, kFirstQuantile), 0);
    for (int round = 0; round < kRounds; ++round) {
        glm::dmat3 squares(1e-9);
        glm::dvec3 products(0);
        for (const Seen& each : seen) {
            const float expected = glm::dot(plane, each.dir);
            const float off = (each.inverse / expected - 1) / kTolerance;
            if (expected <= 0 || std::abs(off) >= 1) continue;
            const float kept = (1 - off * off) / expected;
            const double weight = static_cast<double>(each.area * kept * kept);
            const glm::dvec3 dir(each.dir);
            squares += weight * glm::outerProduct(dir, dir);
            products += weight * static_cast<double>(each.inverse) * dir;
        }
        plane = glm::vec3(glm::inverse(squares) * products);
    }
    return plane;
}

// Collects the known texels below the camera, each with its median over the frames, because under caustics
// each frame gives another distance. The camera's height changes little over these frames. allArea: solid
// angle of all texels looked at.
std::vector<Seen> seenTogether(std::span<const DepthEstimate> frames, float& allArea) {
    std::vector<Seen> seen;
    std::vector<float> known;
    allArea = 0;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        if (dir.y > kLowest) continue;
        const auto area = static_cast<float>(
            texelSolidAngle(static_cast<int>(i / kEstimateWidth), kEstimateWidth, kEstimateHeight));
        allArea += area;
        known.clear();
        for (const DepthEstimate& each : frames)
            if (each.confidence[i] >= kKnown && each.inverse[i] > 0) known.push_back(each.inverse[i]);
        if (known.size() >= kMinTimes) seen.push_back({dir, math::median(known), area});
    }
    return seen;
}

float rising(float from, float to, float value) {
    return std::clamp((value - from) / (to - from), 0.0f, 1.0f);
}

} // namespace

Ground findGround(std::span<const DepthEstimate> frames) {
    float all = 0;
    const std::vector<Seen> seen = seenTogether(frames, all);
    if (seen.empty()) return {};
    Ground ground{.inverse = fittedTo(seen)};
    float near = 0, squares = 0;
    for (const Seen& each : seen) {
        const float off = each.inverse / glm::dot(ground.inverse, each.dir) - 1;
        if (std::abs(off) >= kOnGround) continue;
        near += each.area, squares += each.area * off * off;
    }
    if (near > 0)
        ground.trust = rising(kMinSeen, kEnoughSeen, near / all) *
                       (1 - rising(kFlat, kUneven, std::sqrt(squares / near)));
    return ground;
}

void continueGround(const Ground& ground, DepthEstimate& depth) {
    const float sure = kFilled * ground.trust;
    const float least = kFilledAngle * glm::length(ground.inverse);
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const float inverse = glm::dot(ground.inverse, estimateDirection(i));
        if (inverse > least && sure > depth.confidence[i])
            depth.inverse[i] = inverse, depth.confidence[i] = sure;
    }
}

} // namespace shoal::depth
