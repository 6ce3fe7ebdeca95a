// The ground is continued from where it is seen to where it is not.
#include "content/make/depth/Ground.h"

#include "content/make/depth/FrameRecord.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace shoal::depth {
namespace {

// A plane 1.6 m below the camera that falls to one side by 6 degrees; the inverse distance in a direction is
// its dot product with this.
const glm::vec3 kPlane = glm::normalize(glm::vec3(0.1f, -1, 0.03f)) / 1.6f;

bool isClearlyBelow(const glm::vec3& dir) {
    return glm::dot(kPlane, dir) > std::sin(0.22f) * glm::length(kPlane);
}
bool isBoulder(const glm::vec3& dir) {
    return glm::dot(dir, glm::normalize(glm::vec3(0, -0.6f, -1))) > 0.96f;
}
bool isLit(const glm::vec3& dir) { return dir.x > 0 && std::abs(dir.z) < dir.x; } // a quarter of all around

// Returns a frame that knows the ground exactly in so many of ten texels, in others in each frame. A boulder
// hides some of it, and caustics move over a quarter.
DepthEstimate seenInPlaces(size_t inTen = 5, size_t frame = 0) {
    DepthEstimate depth;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        const float inverse = glm::dot(kPlane, dir);
        const bool isKnown = inverse > 0 && !isLit(dir) && (i * 7919 + frame * 3) % 10 < inTen;
        depth.inverse.push_back(isBoulder(dir) ? 1.6f * inverse : isKnown ? inverse : 3.0f);
        depth.confidence.push_back(isBoulder(dir) ? 0.9f : isKnown ? 0.8f : 0.1f);
    }
    return depth;
}

// Returns a frame with a ball below one side of the camera, on ground without any texture.
DepthEstimate ballBelow() {
    const glm::vec3 middle(0.7f, -1.7f, 0);
    const float radius = 1;
    DepthEstimate depth;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        const float along = glm::dot(dir, middle),
                    square = along * along - glm::dot(middle, middle) + radius * radius;
        const bool isSeen = along > 0 && square > 0;
        depth.inverse.push_back(isSeen ? 1 / (along - std::sqrt(square)) : 0.2f);
        depth.confidence.push_back(isSeen ? 0.9f : 0);
    }
    return depth;
}

// Returns the frame twice, since a texel has to be known in two frames.
std::vector<DepthEstimate> twice(const DepthEstimate& depth) { return {depth, depth}; }

} // namespace

TEST(Ground, IsThePlaneThatMostOfItLiesIn) {
    const Ground ground = findGround(twice(seenInPlaces()));
    EXPECT_EQ(ground.trust, 1);
    EXPECT_NEAR(glm::distance(ground.inverse, kPlane), 0, 0.005f * glm::length(kPlane));
}

// Each frame knows a tenth of the ground, all frames together three quarters; one frame in five believes that
// it is twice as far.
TEST(Ground, FramesTellOfItTogether) {
    std::vector<DepthEstimate> frames;
    for (size_t frame = 0; frame < kGroundFrames; ++frame) {
        frames.push_back(seenInPlaces(1, frame));
        for (float& each : frames.back().inverse) each *= frame % 5 == 0 ? 0.5f : 1;
    }
    EXPECT_EQ(findGround(twice(frames[1])).trust, 0);
    const Ground ground = findGround(frames);
    EXPECT_EQ(ground.trust, 1);
    EXPECT_NEAR(glm::distance(ground.inverse, kPlane), 0, 0.005f * glm::length(kPlane));
}

TEST(Ground, GoesOnWhereTooLittleIsKnown) {
    const DepthEstimate before = seenInPlaces();
    DepthEstimate depth = before;
    continueGround(findGround(twice(depth)), depth);
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        if (isBoulder(dir) || dir.y > 0) {
            EXPECT_EQ(depth.inverse[i], before.inverse[i]);
            EXPECT_EQ(depth.confidence[i], before.confidence[i]);
        } else if (isClearlyBelow(dir)) {
            EXPECT_NEAR(depth.inverse[i] / glm::dot(kPlane, dir), 1, 0.02f);
            EXPECT_GE(depth.confidence[i], 0.6f);
        }
    }
}

// Less than a quarter of confidence says nothing (content/README.md).
TEST(Ground, AThingBelowIsNoGround) {
    const DepthEstimate before = ballBelow();
    DepthEstimate depth = before;
    continueGround(findGround(twice(depth)), depth);
    for (size_t i = 0; i < kEstimateTexels; ++i)
        if (before.confidence[i] > 0)
            EXPECT_EQ(depth.inverse[i], before.inverse[i]);
        else
            EXPECT_LT(depth.confidence[i], 0.25f);
}

TEST(Ground, IsMissingWhereNothingIsKnown) {
    const DepthEstimate nothing{std::vector<float>(kEstimateTexels, 1), std::vector<float>(kEstimateTexels)};
    EXPECT_EQ(findGround(twice(nothing)).trust, 0);
    EXPECT_EQ(findGround({}).trust, 0);
}

} // namespace shoal::depth
