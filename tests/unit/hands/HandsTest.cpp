#include "engine/core/WriteFile.h"
#include "input/hands/HandRig.h"
#include "input/hands/MouseHands.h"
#include "tests/TestPaths.h"
#include "tests/TestRig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace shoal::hands {
namespace {

using tests::rig;

using testing::HasSubstr;

// Chains of five float rotations on lengths below 0.2 m.
constexpr float kTol = 2e-6f;

HandShape shape(float curl, float spread = 0) {
    HandShape s;
    s.curl.fill(curl);
    s.spread = spread;
    return s;
}

TEST(HandRig, RestIsTheFilesOwnPose) {
    // The wrist's -Z points to middle_proximal in the file.
    const glm::vec3 z = -glm::normalize(glm::vec3(-0.004f, 0.004f, -0.096f));
    const glm::vec3 x = glm::normalize(glm::cross(glm::vec3(0, 1, 0), z));
    const WristPose wrist{{0, 0, 0}, glm::quat_cast(glm::mat3(x, glm::cross(z, x), z))};
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
                const WristPose wrist{{0.1f, -0.2f, -0.5f},
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
    renamed.replace(renamed.find("\"wrist\""), 7, "\"waist\"");
    const auto read = load(renamed);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message(), HasSubstr("wrist"));
    std::string far = good;
    far.replace(far.find("-0.060]"), 7, "-6e30 ]");
    EXPECT_FALSE(load(far));
    for (const char* key : {"position", "up", "radius"})
        for (const char* none : {"nan", "-inf", "1e999", "1e300", "1e30"}) {
            std::string bad = good;
            const size_t at = bad.find_first_of("-0123456789", bad.find(key, bad.find("index_proximal")));
            bad.replace(at, bad.find_first_of(",]}", at) - at, none);
            EXPECT_FALSE(load(bad)) << key << " " << none;
        }
    std::filesystem::remove(file);
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

MouseInput pointing(float x, float y) {
    MouseInput input;
    input.cursor = {x, y};
    return input;
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
                MouseInput input = pointing(x, y);
                input.aspect = aspect;
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
    MouseInput input = pointing(0, 0);
    input.wheel = 3;
    settle(mouse, input);
    EXPECT_FLOAT_EQ(mouse.distance_m(), kReachMax_m);
    input.wheel = -3;
    settle(mouse, input);
    EXPECT_FLOAT_EQ(mouse.distance_m(), kReachMin_m);
}

TEST(MouseHands, ClosesInAboutTheSameTimeAtAnyFrameRate) {
    for (int fps : {30, 60, 144}) {
        MouseHands mouse(rig());
        MouseInput input = pointing(0, 0);
        settle(mouse, input);
        input.close = true;
        float elapsed = 0;
        while (mouse.update(input, 1.0f / static_cast<float>(fps))[1].grip < 0.9f && elapsed < 1)
            elapsed += 1.0f / static_cast<float>(fps);
        EXPECT_GT(elapsed, 0.05f) << fps;
        EXPECT_LT(elapsed, 0.13f) << fps;
        input.close = false;
        EXPECT_LT(settle(mouse, input)[1].grip, 0.2f);
    }
}

TEST(MouseHands, SwapsHands) {
    MouseHands mouse(rig());
    MouseInput input = pointing(0.2f, 0.1f);
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
    MouseInput input = pointing(0, 0);
    input.reach_m = 1.1f;
    settle(mouse, input); // 0.4 m at 0.55 m/s at most, then by 1/e in 0.12 s: to a millimetre in 1.4 s
    settle(mouse, input);
    EXPECT_NEAR(mouse.distance_m(), 1.1f, 1e-3f);
    input.reach_m.reset();
    input.close = true;
    settle(mouse, input);
    input.reach_m = 0.4f;
    settle(mouse, input);
    EXPECT_NEAR(mouse.distance_m(), 1.1f, 1e-3f) << "a closed hand stays where it closed";
    input.close = false;
    input.wheel = 1;
    mouse.update(input, 1.0f / 60);
    input.wheel = 0;
    EXPECT_GT(mouse.update(input, 1.0f / 60)[1].confidence, 0);
    EXPECT_GT(mouse.distance_m(), 1.1f);
}

TEST(MouseHands, OddInputStaysPlausible) {
    MouseHands mouse(rig());
    MouseInput input = pointing(9, -9);
    input.wheel = 1e9f;
    input.aspect = 0;
    input.fovY = 100;
    for (float dt : {0.0f, -1.0f, 1e9f, std::numeric_limits<float>::quiet_NaN()})
        for (const HandPose& hand : mouse.update(input, dt)) EXPECT_TRUE(plausible(hand));
}

} // namespace
} // namespace shoal::hands
