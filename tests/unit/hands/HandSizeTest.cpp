#include "input/hands/HandSize.h"
#include "tests/TestRig.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::hands {
namespace {

using State = HandSizing::State;

constexpr float kDt_s = 1.0f / 60;

void hold(HandSizing& sizing, std::optional<float> asRig_m, float time_s) {
    for (float t = 0; t < time_s; t += kDt_s) sizing.see(asRig_m, kDt_s);
}

TEST(HandSize, AHandOfAnotherSizeLooksTheSame) {
    const HandPose rigs = tests::rig().pose(Side::Right, {}, {{0.1f, -0.05f, -0.4f}, {1, 0, 0, 0}});
    HandPose small = rigs;
    resize(small, 0.8f);
    for (size_t i = 0; i < kJointCount; ++i) {
        const glm::vec3 was = rigs.joints[i].position, is = small.joints[i].position;
        EXPECT_NEAR(is.x / is.z, was.x / was.z, 1e-6f);
        EXPECT_NEAR(is.y / is.z, was.y / was.z, 1e-6f);
        EXPECT_NEAR(is.z, 0.8f * was.z, 1e-6f);
    }
    EXPECT_FLOAT_EQ(small.joints[kPalmJoint].radius, 0.8f * rigs.joints[kPalmJoint].radius);
    EXPECT_NEAR(spanOf(small), 0.8f * spanOf(rigs), 1e-6f);
}

TEST(HandSize, IsWhatMakesAStillHandAsFarAsItIs) {
    HandSizing sizing;
    EXPECT_EQ(sizing.state(), State::Waiting);
    hold(sizing, 0.9f * HandSizing::kAt_m, HandSizing::kHold_s / 2);
    EXPECT_EQ(sizing.state(), State::Holding);
    EXPECT_NEAR(sizing.progress(), 0.5f, 0.05f);
    EXPECT_FALSE(sizing.size());
    hold(sizing, 0.9f * HandSizing::kAt_m, HandSizing::kHold_s / 2);
    ASSERT_EQ(sizing.state(), State::Done);
    EXPECT_NEAR(*sizing.size(), 1 / 0.9f, 1e-4f);
    hold(sizing, {}, 1);
    EXPECT_EQ(sizing.state(), State::Done) << "the hand may go then";
}

TEST(HandSize, AHandThatMovesOrGoesBeginsAnew) {
    HandSizing sizing;
    hold(sizing, HandSizing::kAt_m, 0.8f * HandSizing::kHold_s);
    hold(sizing, 1.1f * HandSizing::kAt_m, 0.8f * HandSizing::kHold_s);
    EXPECT_EQ(sizing.state(), State::Holding);
    hold(sizing, {}, HandSizing::kMissing_s / 2); // between two pictures
    EXPECT_EQ(sizing.state(), State::Holding);
    hold(sizing, {}, HandSizing::kMissing_s);
    EXPECT_EQ(sizing.state(), State::Waiting);
    EXPECT_EQ(sizing.progress(), 0);
}

TEST(HandSize, IsNeverThatOfNoHand) {
    HandSizing sizing;
    hold(sizing, 1.1f * HandSizing::kAt_m / kHandSizeMin, 3);
    EXPECT_EQ(sizing.state(), State::Elsewhere) << "it is held much farther away";
    hold(sizing, 0.9f * HandSizing::kAt_m / kHandSizeMax, 3);
    EXPECT_EQ(sizing.state(), State::Elsewhere);
    hold(sizing, 0.0f, 3);
    EXPECT_EQ(sizing.state(), State::Elsewhere);
    hold(sizing, HandSizing::kAt_m, 2 * HandSizing::kHold_s);
    EXPECT_EQ(sizing.state(), State::Done);
}

} // namespace
} // namespace shoal::hands
