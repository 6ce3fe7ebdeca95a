// Joints and controllers as hands in the viewer's frame.
#include "input/hands/OpenXrHands.h"
#include "tests/Test.h"
#include "tests/TestRig.h"

namespace shoal::hands {
namespace {

// Rounding of sums and products of a few floats below 3.
constexpr float kTol = 3e-6f;

using tests::rig;

const xr::Pose kHead{{0.4f, -0.1f, 0.7f}, glm::normalize(glm::quat(0.8f, 0.2f, -0.5f, 0.1f))};

// Returns a hand as a headset would report it: with joints in the world frame, without grip and pinch.
HandPose reported(const HandPose& inView, const xr::Pose& head) {
    HandPose hand = inView;
    for (Joint& joint : hand.joints) {
        const xr::Pose worldFromJoint = head * xr::Pose{joint.position, joint.orientation};
        joint.position = worldFromJoint.position;
        joint.orientation = worldFromJoint.orientation;
    }
    hand.grip = hand.pinch = 0;
    return hand;
}

HandPose some(Side side, float curl) {
    return rig().pose(side, tests::shape(curl),
                      {{0.1f, -0.2f, -0.5f}, glm::normalize(glm::quat(0.9f, 0.3f, 0.1f, -0.2f))});
}

TEST(OpenXrHands, JointsComeBackInTheViewersFrame) {
    for (const Side side : {Side::Left, Side::Right})
        for (const float curl : {0.0f, 0.5f, 1.0f}) {
            const HandPose given = some(side, curl);
            const HandPose hand = handFromJoints(reported(given, kHead), kHead);
            ASSERT_TRUE(hand.tracked);
            EXPECT_EQ(hand.confidence, 1);
            EXPECT_TRUE(plausible(hand));
            for (size_t i = 0; i < hand.joints.size(); ++i) {
                EXPECT_LT(glm::distance(hand.joints[i].position, given.joints[i].position), kTol) << i;
                EXPECT_NEAR(std::abs(glm::dot(hand.joints[i].orientation, given.joints[i].orientation)), 1,
                            kTol);
                EXPECT_EQ(hand.joints[i].radius, given.joints[i].radius);
            }
            EXPECT_NEAR(hand.grip, given.grip, 1e-4f); // by acos of floats
            EXPECT_NEAR(hand.pinch, given.pinch, 1e-4f);
        }
}

xr::Controller heldUpright(float squeeze = 0, float trigger = 0) {
    // A rod held upright ahead, as for shaking hands: OpenXR has -Z up along it, +X right, +Y to the player.
    const glm::mat3 turn(glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, -1, 0));
    return {xr::Pose{{0.2f, -0.2f, -0.4f}, glm::quat_cast(turn)}, squeeze, trigger};
}

TEST(OpenXrHands, AControllerIsHeldAsOpenXrSays) {
    for (const Side side : {Side::Left, Side::Right}) {
        const HandPose hand = handFromController(rig(), side, heldUpright(), {});
        ASSERT_TRUE(hand.tracked);
        EXPECT_TRUE(plausible(hand));
        const Joint& palm = hand.joints[0];
        const glm::vec3 fingers = palm.orientation * glm::vec3(0, 0, -1);
        const glm::vec3 back = palm.orientation * glm::vec3(0, 1, 0);
        // Fingers ahead, palms facing each other, thumbs up; the palm joint turns a few degrees on the wrist.
        EXPECT_GT(glm::dot(fingers, glm::vec3(0, 0, -1)), 0.95f);
        EXPECT_GT(glm::dot(back, glm::vec3(side == Side::Right ? 1 : -1, 0, 0)), 0.95f);
        EXPECT_GT(hand.joints[5].position.y, hand.joints[25].position.y + 0.05f);
        // The palm's surface touches the grip.
        const glm::vec3 surface = palm.position - back * palm.radius;
        EXPECT_LT(glm::distance(surface, heldUpright().worldFromGrip->position), kTol);
    }
}

TEST(OpenXrHands, AControllerIsSeenFromTheHead) {
    const HandPose straight = handFromController(rig(), Side::Right, heldUpright(), {});
    xr::Controller moved = heldUpright();
    moved.worldFromGrip = kHead * *moved.worldFromGrip;
    const HandPose turned = handFromController(rig(), Side::Right, moved, kHead);
    for (size_t i = 0; i < straight.joints.size(); ++i)
        EXPECT_LT(glm::distance(straight.joints[i].position, turned.joints[i].position), kTol);
}

TEST(OpenXrHands, SqueezingClosesTheHandAndTheTriggerAloneDoesNot) {
    // The game closes a hand above 0.55 and opens it below 0.35.
    EXPECT_LT(handFromController(rig(), Side::Right, heldUpright(0, 0), {}).grip, 0.35f);
    EXPECT_GT(handFromController(rig(), Side::Right, heldUpright(1, 0), {}).grip, 0.55f);
    EXPECT_GT(handFromController(rig(), Side::Right, heldUpright(1, 1), {}).grip, 0.9f);
    EXPECT_LT(handFromController(rig(), Side::Right, heldUpright(0, 1), {}).grip, 0.5f);
}

TEST(OpenXrHands, BareHandsComeBeforeControllersBeforeNothing) {
    xr::Tracking tracking;
    tracking.worldFromHead = kHead;
    tracking.controllers[0] = tracking.controllers[1] = heldUpright(1);
    const HandPose open = some(Side::Right, 0);
    tracking.hands[1] = reported(open, kHead);
    auto hands = openXrHands(rig(), tracking);
    EXPECT_TRUE(hands[0].tracked);
    EXPECT_GT(hands[0].grip, 0.55f); // the controller's
    EXPECT_NEAR(hands[1].grip, open.grip, 1e-4f);
    tracking.hands[1].tracked = false;
    EXPECT_GT(openXrHands(rig(), tracking)[1].grip, 0.55f);
    tracking.controllers = {};
    hands = openXrHands(rig(), tracking);
    EXPECT_FALSE(hands[0].tracked);
    EXPECT_FALSE(hands[1].tracked);
    tracking.controllers[0] = heldUpright();
    tracking.controllers[0].worldFromGrip.reset();
    EXPECT_FALSE(openXrHands(rig(), tracking)[0].tracked);
}

} // namespace
} // namespace shoal::hands
