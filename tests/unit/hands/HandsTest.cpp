#include "engine/core/WriteFile.h"
#include "input/hands/CompleteHand.h"
#include "input/hands/HandTracker.h"
#include "input/hands/MouseHands.h"
#include "tests/Test.h"
#include "tests/TestRig.h"

namespace shoal::hands {
namespace {

using tests::rig;
using tests::shape;

// Chains of five float rotations on lengths below 0.2 m.
constexpr float kTol = 2e-6f;

TEST(HandRig, RestIsTheFilesOwnPose) {
    // The wrist's -Z points to middle_proximal in the file.
    const glm::vec3 z = -glm::normalize(glm::vec3(-0.004f, 0.004f, -0.096f));
    const glm::vec3 x = glm::normalize(glm::cross(glm::vec3(0, 1, 0), z));
    const JointPose wrist{{0, 0, 0}, glm::quat_cast(glm::mat3(x, glm::cross(z, x), z))};
    const HandPose hand = rig().pose(Side::Right, shape(0), wrist);
    EXPECT_NEAR(glm::distance(hand.joints[0].position, glm::vec3(-0.004f, -0.004f, -0.060f)), 0, kTol);
    EXPECT_NEAR(glm::distance(hand.joints[15].position, glm::vec3(-0.004f, 0.001f, -0.191f)), 0, kTol);
    EXPECT_EQ(hand.joints[10].radius, 0.0065f);
    EXPECT_LT(hand.grip, 0.05f);
    EXPECT_TRUE(plausible(hand));
}

TEST(HandRig, BonesKeepTheirLengthAndJointsTheirConvention) {
    const HandRig hand = rig();
    for (Side side : {Side::Left, Side::Right})
        for (float curl : {0.0f, 0.3f, 0.7f, 1.0f})
            for (float spread : {-1.0f, 0.0f, 1.0f}) {
                const JointPose wrist{{0.1f, -0.2f, -0.5f},
                                      glm::normalize(glm::quat(0.8f, 0.1f, -0.5f, 0.3f))};
                const HandPose pose = hand.pose(side, shape(curl, spread), wrist);
                ASSERT_TRUE(plausible(pose));
                for (int i = 0; i < kJointCount; ++i) {
                    if (kJointParent[i] < 0) continue;
                    const glm::vec3 from = pose.joints[kJointParent[i]].position;
                    EXPECT_NEAR(glm::distance(from, pose.joints[i].position), hand.boneLength(i), kTol);
                }
                // Each finger joint's -Z points to the next one.
                for (int i : {2, 3, 4, 6, 7, 8, 9, 11, 12, 13, 14, 16, 17, 18, 19, 21, 22, 23, 24}) {
                    const glm::vec3 to =
                        glm::normalize(pose.joints[i + 1].position - pose.joints[i].position);
                    EXPECT_NEAR(glm::dot(pose.joints[i].orientation * glm::vec3(0, 0, -1), to), 1, 1e-4f)
                        << i;
                }
            }
}

TEST(HandRig, LeftMirrorsRight) {
    const HandRig hand = rig();
    const HandPose left = hand.pose(Side::Left, shape(0.6f, 0.4f), {});
    const HandPose right = hand.pose(Side::Right, shape(0.6f, 0.4f), {});
    for (int i = 0; i < kJointCount; ++i) {
        const glm::vec3 p = right.joints[i].position;
        EXPECT_NEAR(glm::distance(left.joints[i].position, glm::vec3(-p.x, p.y, p.z)), 0, kTol);
        const glm::vec3 up = right.joints[i].orientation * glm::vec3(0, 1, 0);
        EXPECT_NEAR(
            glm::distance(left.joints[i].orientation * glm::vec3(0, 1, 0), glm::vec3(-up.x, up.y, up.z)), 0,
            kTol);
    }
}

TEST(HandRig, AFistBendsTowardsThePalmAndGripsAll) {
    const HandRig hand = rig();
    const HandPose fist = hand.pose(Side::Right, shape(1), {});
    EXPECT_GT(fist.grip, 0.95f);
    for (int tip : {10, 15, 20, 25}) EXPECT_LT(fist.joints[tip].position.y, -0.01f) << "palm side is -Y";
    float before = -1;
    for (float curl = 0; curl <= 1.001f; curl += 0.1f) {
        const float grip = hand.pose(Side::Right, shape(curl), {}).grip;
        EXPECT_GE(grip, before);
        before = grip;
    }
    // The grasp centre is nearer to every fingertip than when open.
    const HandPose open = hand.pose(Side::Right, shape(0), {});
    for (const auto& [metacarpal, proximal, tip] : kFingerJoints)
        EXPECT_LT(glm::distance(fist.joints[tip].position, graspCentre(fist.joints)),
                  glm::distance(open.joints[tip].position, graspCentre(open.joints)));
}

TEST(HandRig, RefusesWhatIsNoSkeleton) {
    const tests::ScratchFolder folder;
    const Path file = folder / "skeleton.json";
    const std::string good = readText(dataRoot() / "content/models/hand_skeleton.json").value();
    const auto load = [&](const std::string& text) {
        EXPECT_TRUE(writeFileWhole(file, text));
        return HandRig::load(file);
    };
    EXPECT_TRUE(load(good));
    for (const char* text : {"", "[]", "{\"joints\":3}", "{\"joints\":[]}"}) EXPECT_FALSE(load(text)) << text;
    std::string renamed = good;
    renamed.replace(renamed.find("\"radius\""), 8, "\"width\"");
    EXPECT_THAT(tests::errorOf(load(renamed)).message(), testing::HasSubstr("26 joints"));
}

TEST(Plausible, RefusesAbsurdJoints) {
    const HandPose good = rig().pose(Side::Right, shape(0), {});
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (float bad : {nan, inf, -inf, 1e20f, 7.0f}) {
        HandPose hand = good;
        hand.joints[12].position.y = bad;
        EXPECT_FALSE(plausible(hand)) << bad;
        hand = good;
        hand.joints[3].orientation.x = bad;
        EXPECT_FALSE(plausible(hand)) << bad;
        hand = good;
        hand.joints[3].radius = bad;
        EXPECT_FALSE(plausible(hand)) << bad;
    }
    HandPose torn = good;
    torn.joints[25].position.x += 0.4f;
    EXPECT_FALSE(plausible(torn));
}

TEST(ReachingHand, PutsTheGraspWhereAsked) {
    const HandRig hand = rig();
    for (Side side : {Side::Left, Side::Right})
        for (glm::vec3 at : {glm::vec3(0, 0, -0.7f), glm::vec3(0.5f, -0.4f, -0.4f),
                             glm::vec3(-0.6f, 0.5f, -0.9f), glm::vec3(0, 0, 0.4f), glm::vec3(0, 1, 0)})
            for (float closed : {0.0f, 0.5f, 1.0f}) {
                const HandPose pose = reachingHand(hand, side, at, closed);
                EXPECT_TRUE(plausible(pose));
                EXPECT_NEAR(glm::distance(graspCentre(pose.joints), at), 0, 1e-5f);
            }
    EXPECT_LT(reachingHand(hand, Side::Right, {0, 0, -0.7f}, 0).grip, 0.2f);
    EXPECT_GT(reachingHand(hand, Side::Right, {0, 0, -0.7f}, 1).grip, 0.9f);
}

const std::array<HandPose, 2>& settle(MouseHands& mouse, const MouseInput& input, float seconds = 1) {
    for (float t = 0; t < seconds; t += 1.0f / 60) mouse.update(input, 1.0f / 60);
    return mouse.update(input, 1.0f / 60);
}

TEST(MouseHands, TheActiveHandLiesOnTheCursorsRay) {
    for (float aspect : {1.0f, 16.f / 9, 21.f / 9})
        for (float x : {-1.0f, -0.3f, 0.0f, 0.8f})
            for (float y : {-0.9f, 0.0f, 1.0f}) {
                MouseHands mouse(rig());
                const MouseInput input{.cursor = {x, y}, .aspect = aspect};
                const auto& poses = settle(mouse, input);
                const glm::vec3 at = graspCentre(poses[1].joints);
                const float tanY = std::tan(0.5f * input.fovY);
                EXPECT_NEAR(at.x / -at.z, x * tanY * aspect, 1e-3f); // settled to e^-40, then float
                EXPECT_NEAR(at.y / -at.z, y * tanY, 1e-3f);
                EXPECT_NEAR(glm::length(at), mouse.distance_m(), 1e-4f);
            }
}

TEST(MouseHands, TheWheelReachesBetweenTheLimits) {
    MouseHands mouse(rig());
    MouseInput input{.wheel = 3};
    settle(mouse, input);
    EXPECT_FLOAT_EQ(mouse.distance_m(), kReachMax_m);
    input.wheel = -3;
    settle(mouse, input);
    EXPECT_FLOAT_EQ(mouse.distance_m(), kReachMin_m);
}

TEST(MouseHands, ClosesInAboutTheSameTimeAtAnyFrameRate) {
    for (int fps : {30, 60, 144}) {
        MouseHands mouse(rig());
        MouseInput input;
        settle(mouse, input);
        input.close = 1;
        float elapsed = 0;
        while (mouse.update(input, 1.0f / static_cast<float>(fps))[1].grip < 0.9f && elapsed < 1)
            elapsed += 1.0f / static_cast<float>(fps);
        EXPECT_GT(elapsed, 0.05f) << fps;
        EXPECT_LT(elapsed, 0.13f) << fps;
        input.close = 0;
        EXPECT_LT(settle(mouse, input)[1].grip, 0.2f);
    }
}

TEST(MouseHands, SwapsHands) {
    MouseHands mouse(rig());
    MouseInput input{.cursor = {0.2f, 0.1f}};
    const glm::vec3 before = graspCentre(settle(mouse, input)[1].joints);
    input.swapHands = true;
    mouse.update(input, 1.0f / 60);
    EXPECT_EQ(mouse.active(), Side::Left);
    input.swapHands = false;
    const auto& poses = settle(mouse, input);
    EXPECT_NEAR(glm::distance(graspCentre(poses[0].joints), before), 0, 1e-3f);
    EXPECT_GT(graspCentre(poses[1].joints).x, 0.1f);
    EXPECT_LT(graspCentre(poses[1].joints).y, -0.2f);
    EXPECT_TRUE(poses[0].tracked && poses[1].tracked);
}

TEST(MouseHands, HelpWithDepthIsTakenWhileOpenAndOverruledByTheWheel) {
    MouseHands mouse(rig());
    MouseInput input{.reach_m = 1.1f};
    settle(mouse, input); // 0.4 m at 0.55 m/s at most, then by 1/e in 0.12 s: to a millimetre in 1.4 s
    settle(mouse, input);
    EXPECT_NEAR(mouse.distance_m(), 1.1f, 1e-3f);
    input.reach_m.reset();
    input.close = 1;
    settle(mouse, input);
    input.reach_m = 0.4f;
    settle(mouse, input);
    EXPECT_NEAR(mouse.distance_m(), 1.1f, 1e-3f) << "a closed hand stays where it closed";
    input.close = 0;
    input.wheel = 1;
    mouse.update(input, 1.0f / 60);
    input.wheel = 0;
    EXPECT_GT(mouse.update(input, 1.0f / 60)[1].confidence, 0);
    EXPECT_GT(mouse.distance_m(), 1.1f);
}

TEST(MouseHands, OddInputStaysPlausible) {
    MouseHands mouse(rig());
    const MouseInput input{.cursor = {9, -9}, .wheel = 1e9f, .aspect = 0, .fovY = 100};
    for (float dt : {0.0f, -1.0f, 1e9f, std::numeric_limits<float>::quiet_NaN()})
        for (const HandPose& hand : mouse.update(input, dt)) EXPECT_TRUE(plausible(hand));
}

enum class Sent { Everything, Skeleton };

PartialHand partial(const HandPose& pose, Sent sent) {
    PartialHand hand;
    const auto at = [&](int joint) { return pose.joints[joint].position; };
    hand.palm = at(0);
    hand.normal = pose.joints[0].orientation * glm::vec3(0, -1, 0);
    hand.direction = pose.joints[0].orientation * glm::vec3(0, 0, -1);
    if (sent == Sent::Everything) hand.joints[kWristJoint] = at(1);
    for (int f = 0; f < kFingerCount; ++f) {
        const int foot = f == 0 ? 2 : 1 + 5 * f, tip = f == 0 ? 5 : foot + 4;
        for (int joint = foot + 1; joint <= tip; ++joint) hand.joints[joint] = at(joint);
        if (f == 0 || sent == Sent::Everything) hand.joints[foot] = at(foot);
    }
    return hand;
}

HandPose posed(Side side, float curl, glm::quat turn = {1, 0, 0, 0}) {
    return rig().pose(side, shape(curl), {{0.1f, 0.2f, -0.3f}, turn});
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

using State = HandSizing::State;

constexpr float kDt_s = 1.0f / 60;

void hold(HandSizing& sizing, std::optional<float> rigDistance_m, float time_s) {
    for (float t = 0; t < time_s; t += kDt_s) sizing.see(rigDistance_m, kDt_s);
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
