#include "input/hands/CompleteHand.h"
#include "input/hands/HandTracker.h"
#include "tests/TestRig.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::hands {
namespace {

using tests::rig;

enum class Sent { Everything, Skeleton, Tips, LooseTips, Nothing };

PartialHand partial(const HandPose& pose, Sent sent, float size = 1) {
    PartialHand hand;
    const auto at = [&](int joint) { return pose.joints[joint].position * size; };
    hand.palm = at(0);
    hand.normal = pose.joints[0].orientation * glm::vec3(0, -1, 0);
    hand.direction = pose.joints[0].orientation * glm::vec3(0, 0, -1);
    if (sent == Sent::Everything) hand.joints[kWristJoint] = at(1);
    for (int f = 0; f < kFingerCount; ++f) {
        const int foot = f == 0 ? 2 : 1 + 5 * f, tip = f == 0 ? 5 : foot + 4;
        if (sent == Sent::LooseTips) hand.looseTips[hand.looseTipCount++] = at(tip);
        if (sent == Sent::LooseTips || sent == Sent::Nothing) continue;
        hand.joints[tip] = at(tip);
        if (sent == Sent::Tips) continue;
        for (int joint = foot + 1; joint < tip; ++joint) hand.joints[joint] = at(joint);
        if (f == 0 || sent == Sent::Everything) hand.joints[foot] = at(foot);
    }
    return hand;
}

HandPose posed(Side side, float curl, glm::quat turn = {1, 0, 0, 0}) {
    HandShape shape;
    shape.curl.fill(curl);
    return rig().pose(side, shape, {{0.1f, 0.2f, -0.3f}, turn});
}

TEST(CompleteHand, JointsSentStayAndTheRestIsWhereTheRigHasIt) {
    const HandCompleter completer(rig());
    for (Side side : {Side::Left, Side::Right})
        for (float curl : {0.0f, 0.4f, 0.9f}) {
            const HandPose truth = posed(side, curl, glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f)));
            const HandPose all = completer.complete(partial(truth, Sent::Everything), side);
            const HandPose some = completer.complete(partial(truth, Sent::Skeleton), side);
            for (int i = 0; i < kJointCount; ++i) {
                EXPECT_NEAR(glm::distance(all.joints[i].position, truth.joints[i].position), 0, 2e-6f);
                // Wrist and metacarpals hang rigidly from the palm: in the rig's own poses exactly.
                EXPECT_NEAR(glm::distance(some.joints[i].position, truth.joints[i].position), 0, 1e-5f)
                    << kJointNames[i];
                const float turn = glm::dot(all.joints[i].orientation, truth.joints[i].orientation);
                // The thumb rolls a little in the rig when it bends; the least turn does not know.
                EXPECT_GT(std::fabs(turn), 0.985f) << kJointNames[i] << " " << curl;
            }
            EXPECT_TRUE(plausible(some));
        }
}

TEST(CompleteHand, FingersBendAndKeepTheirBonesWhereOnlyTipsAreKnown) {
    const HandCompleter completer(rig());
    for (Side side : {Side::Left, Side::Right})
        for (float size : {0.8f, 1.0f, 1.2f})
            for (float curl : {0.0f, 0.3f, 0.6f, 0.9f}) {
                const HandPose truth = posed(side, curl);
                PartialHand hand = partial(truth, Sent::Tips, size);
                hand.palmWidth_m = 0.085f * size;
                const HandPose made = completer.complete(hand, side);
                ASSERT_TRUE(plausible(made));
                for (int i = 2; i < kJointCount; ++i) {
                    const int parent = kJointParent[i];
                    if (parent < 2) continue; // the carpus gives
                    EXPECT_NEAR(glm::distance(made.joints[i].position, made.joints[parent].position),
                                size * rig().boneLength(i), 1e-5f)
                        << kJointNames[i];
                }
                for (const auto& [metacarpal, proximal, tip] :
                     kFingerJoints) // the curl is found to 2^-14 of a bend of 235 degrees
                    EXPECT_NEAR(glm::distance(made.joints[tip].position, truth.joints[tip].position * size),
                                0, 2e-4f)
                        << kJointNames[tip] << " curl " << curl << " size " << size;
            }
}

TEST(CompleteHand, ATipBeyondReachIsPointedAt) {
    const HandCompleter completer(rig());
    PartialHand hand = partial(posed(Side::Right, 0), Sent::Tips);
    hand.joints[10] = *hand.joints[10] + glm::vec3(0, 0, -0.3f);
    const HandPose made = completer.complete(hand, Side::Right);
    EXPECT_TRUE(plausible(made));
    const glm::vec3 towards = glm::normalize(*hand.joints[10] - made.joints[7].position);
    EXPECT_NEAR(glm::dot(glm::normalize(made.joints[10].position - made.joints[7].position), towards), 1,
                1e-4f);
}

TEST(CompleteHand, LooseTipsFindTheirFingersAndTheHandItsSide) {
    const HandCompleter completer(rig());
    for (Side side : {Side::Left, Side::Right}) {
        HandShape open;
        open.spread = 0.6f;
        const HandPose truth = rig().pose(side, open, {{0, 0.2f, 0}, {1, 0, 0, 0}});
        PartialHand hand = partial(truth, Sent::LooseTips);
        EXPECT_EQ(completer.sideOfTips(hand), side);
        std::swap(hand.looseTips[0], hand.looseTips[3]);
        std::swap(hand.looseTips[1], hand.looseTips[4]);
        const HandPose made = completer.complete(hand, side);
        for (const auto& [metacarpal, proximal, tip] : kFingerJoints)
            EXPECT_NEAR(glm::distance(made.joints[tip].position, truth.joints[tip].position), 0, 2e-3f);
    }
}

TEST(CompleteHand, FingersThatAnOldServiceNoLongerSeesAreBent) {
    const HandCompleter completer(rig());
    PartialHand hand = partial(posed(Side::Right, 0), Sent::Nothing);
    EXPECT_GT(completer.complete(hand, Side::Right).grip, 0.8f);
    hand.grip = 0.0f;
    EXPECT_LT(completer.complete(hand, Side::Right).grip, 0.1f);
    // Index and middle pointing, the others gone.
    const HandPose flat = posed(Side::Right, 0);
    hand.grip.reset();
    hand.looseTips[0] = flat.joints[10].position;
    hand.looseTips[1] = flat.joints[15].position;
    hand.looseTipCount = 2;
    const HandPose pointing = completer.complete(hand, Side::Right);
    EXPECT_NEAR(glm::distance(pointing.joints[10].position, flat.joints[10].position), 0, 2e-3f);
    EXPECT_GT(glm::distance(pointing.joints[20].position, flat.joints[20].position), 0.05f);
}

TEST(Mount, PlacesHandsBeforeTheViewerAndKeepsTheirSize) {
    const struct {
        const Mount& mount;
        glm::vec3 device, viewer;
    } kRows[] = {
        // On the desk up is up and towards the screen is ahead; distances from the middle are scaled.
        {kDeskMount, {0, 0.2f, 0}, {0, -0.12f, -0.75f}},
        {kDeskMount, {0.1f, 0.2f, 0}, {0.1f * kReach, -0.12f, -0.75f}},
        {kDeskMount, {0, 0.3f, 0}, {0, -0.12f + 0.1f * kReach, -0.75f}},
        {kDeskMount, {0, 0.2f, -0.1f}, {0, -0.12f, -0.75f - 0.1f * kReach}},
        // On the head the device's up is ahead, and hands are where they are.
        {kHeadMount, {0, 0.4f, 0}, {0, 0, -0.48f}},
        {kHeadMount, {0.1f, 0.4f, 0}, {-0.1f, 0, -0.48f}},
        {kHeadMount, {0, 0.4f, 0.1f}, {0, -0.1f, -0.48f}},
        // The camera mirrors, and nearer to it is farther from the viewer.
        {kCameraMount, {0, -0.05f, -0.5f}, {0, -0.12f, -0.75f}},
        {kCameraMount, {0.1f, -0.05f, -0.5f}, {-0.1f * kReach, -0.12f, -0.75f}},
        {kCameraMount, {0, 0.05f, -0.5f}, {0, -0.12f + 0.1f * kReach, -0.75f}},
        {kCameraMount, {0, -0.05f, -0.4f}, {0, -0.12f, -0.75f - 0.1f * kReach}},
    };
    const HandPose before = posed(Side::Right, 0);
    for (const auto& [mount, device, viewer] : kRows) {
        HandPose hand = before;
        for (Joint& joint : hand.joints) joint.position += device - before.joints[kPalmJoint].position;
        mount.apply(hand);
        EXPECT_LT(glm::distance(hand.joints[kPalmJoint].position, viewer), 1e-6f);
        for (int i = 0; i < kJointCount; ++i)
            EXPECT_NEAR(glm::distance(hand.joints[i].position, hand.joints[kPalmJoint].position),
                        glm::distance(before.joints[i].position, before.joints[kPalmJoint].position), 1e-6f);
    }
    // The middle of the box is within reach of fish and hand alike.
    EXPECT_GT(glm::length(kDeskMount.centreViewer_m), kReachMin_m);
    EXPECT_LT(glm::length(kDeskMount.centreViewer_m), kReachMax_m);
}

} // namespace
} // namespace shoal::hands
