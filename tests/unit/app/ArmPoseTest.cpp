// Arms reach from an estimated shoulder to where the hand is, whatever the hand and the head do.
#include "game/views/ArmPose.h"
#include "engine/scene/Model.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace shoal::app {
namespace {

constexpr float kNear_m = 1e-5f; // of single precision, at arm's length

glm::vec3 placeOf(const ArmPose& arm, ArmJoint joint) {
    return glm::vec3(arm[static_cast<size_t>(joint)][3]);
}

float bendOf(const ArmPose& arm) { // radians; 0: straight
    const glm::vec3 elbow = placeOf(arm, ArmJoint::Elbow);
    const glm::vec3 fore = glm::normalize(placeOf(arm, ArmJoint::Wrist) - elbow),
                    upper = glm::normalize(elbow - placeOf(arm, ArmJoint::UpperArm));
    return std::acos(glm::clamp(glm::dot(fore, upper), -1.0f, 1.0f));
}

std::vector<Head> heads() {
    std::vector<Head> all;
    for (int yaw = -180; yaw < 180; yaw += 60)
        for (int pitch = -90; pitch <= 90; pitch += 15)
            for (int roll = -60; roll <= 60; roll += 30)
                all.push_back(
                    {{0.1f, -0.2f, 0.3f},
                     glm::angleAxis(glm::radians(static_cast<float>(yaw)), glm::vec3(0, 1, 0)) *
                         glm::angleAxis(glm::radians(static_cast<float>(pitch)), glm::vec3(1, 0, 0)) *
                         glm::angleAxis(glm::radians(static_cast<float>(roll)), glm::vec3(0, 0, 1))});
    return all;
}

// The bones keep their lengths within reach, and by the law of cosines the elbow's angle follows.
TEST(ArmPose, BendsAsTheLawOfCosinesSays) {
    const glm::vec3 shoulder = shoulderWorld(hands::Side::Right, {});
    for (const float distance : {0.1f, 0.2f, 0.4f, 0.55f}) {
        const hands::Joint wrist{.position =
                                     shoulder + distance * glm::normalize(glm::vec3(-0.3f, 0.4f, -1))};
        const ArmPose arm = poseArm(hands::Side::Right, wrist, {});
        EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Wrist), placeOf(arm, ArmJoint::Elbow)), kForearm_m,
                    kNear_m);
        EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Elbow), shoulder), kUpperArm_m, kNear_m);
        const float cosine = (distance * distance - kForearm_m * kForearm_m - kUpperArm_m * kUpperArm_m) /
                             (2 * kForearm_m * kUpperArm_m);
        EXPECT_NEAR(std::cos(bendOf(arm)), cosine, 1e-4f) << distance;
        EXPECT_NEAR(stretchOf(arm), 1, 1e-4f);
        EXPECT_LT(placeOf(arm, ArmJoint::Elbow).y, std::max(shoulder.y, wrist.position.y)); // it hangs
    }
}

TEST(ArmPose, StretchesBothBonesAlikeBeyondItsReach) {
    const glm::vec3 shoulder = shoulderWorld(hands::Side::Left, {});
    const float distance = 1.5f * (kForearm_m + kUpperArm_m);
    const ArmPose arm = poseArm(hands::Side::Left, {.position = shoulder + glm::vec3(0, 0, -distance)}, {});
    EXPECT_NEAR(stretchOf(arm), 1.5f, 1e-4f);
    EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Wrist), placeOf(arm, ArmJoint::Elbow)),
                1.5f * kForearm_m, 1e-4f);
    EXPECT_NEAR(bendOf(arm), 0, 0.01f);
}

// An elbow on the circle where both bones meet is where the arm bends, whatever the head does; nothing
// changes where none is given, or one that lies in the line from wrist to shoulder.
TEST(ArmPose, BendsAtTheElbowThatATrackerGives) {
    const hands::Side side = hands::Side::Right;
    for (const Head& head : heads()) {
        const glm::vec3 shoulder = shoulderWorld(side, head);
        const hands::Joint wrist{.position = shoulder + head.worldFromView * glm::vec3(-0.15f, 0.1f, -0.35f)};
        const glm::vec3 apart = shoulder - wrist.position;
        const float distance = glm::length(apart);
        const glm::vec3 back = apart / distance;
        const float along =
            (distance * distance + kForearm_m * kForearm_m - kUpperArm_m * kUpperArm_m) / (2 * distance);
        const float off = std::sqrt(kForearm_m * kForearm_m - along * along);
        const glm::vec3 first = glm::normalize(glm::cross(back, head.worldFromView * glm::vec3(0, 1, 0)));
        for (int turn = 0; turn < 360; turn += 30) {
            const glm::vec3 point = glm::angleAxis(glm::radians(static_cast<float>(turn)), back) * first;
            const glm::vec3 elbow = wrist.position + along * back + off * point;
            const ArmPose arm = poseArm(side, wrist, head, (elbow - wrist.position) / kForearm_m);
            EXPECT_LT(glm::distance(placeOf(arm, ArmJoint::Elbow), elbow), kNear_m) << turn;
        }
        const glm::vec3 loose = placeOf(poseArm(side, wrist, head), ArmJoint::Elbow);
        EXPECT_EQ(placeOf(poseArm(side, wrist, head, back), ArmJoint::Elbow), loose);
    }
}

// For every head and hand: the wrist is the hand's own, joints are rotations, and the shoulder is out of the
// picture.
TEST(ArmPose, HoldsForEveryHeadAndHand) {
    for (const Head& head : heads())
        for (const hands::Side side : {hands::Side::Left, hands::Side::Right})
            for (const glm::vec3 place :
                 {glm::vec3(0, 0, -0.3f), glm::vec3(-0.4f, 0.3f, -0.5f), glm::vec3(0.5f, -0.4f, 0.1f),
                  glm::vec3(0, 0.2f, -1.2f), glm::vec3(0)}) {
                const hands::Joint wrist{.position = place == glm::vec3(0)
                                                         ? shoulderWorld(side, head)
                                                         : head.positionWorld + head.worldFromView * place,
                                         .orientation = head.worldFromView};
                const ArmPose arm = poseArm(side, wrist, head);
                EXPECT_EQ(placeOf(arm, ArmJoint::Wrist), wrist.position);
                for (const glm::mat4& joint : arm) {
                    EXPECT_NEAR(glm::determinant(glm::mat3(joint)), 1, 1e-3f);
                    for (int axis = 0; axis < 3; ++axis)
                        EXPECT_NEAR(glm::length(glm::vec3(joint[axis])), 1, 1e-3f);
                }
                const glm::vec3 inView =
                    glm::conjugate(head.worldFromView) * (shoulderWorld(side, head) - head.positionWorld);
                EXPECT_GT(inView.z, 0.02f);
                EXPECT_GT(std::hypot(inView.x, inView.y), 0.32f);
            }
}

// The game's arm models have their joints where poseArm() expects them, are closed behind, and enclose the
// wrist.
TEST(ArmModels, AreWhatTheyArePosedAs) {
    for (const char* name : {"arm_left", "arm_right"}) {
        const auto model = scene::loadModel(dataRoot() / "content/models" / (std::string(name) + ".glb"));
        ASSERT_TRUE(model.ok()) << model.error().message();
        scene::Pose rest;
        scene::restPose(*model, rest);
        scene::updateGlobals(*model, rest);
        const std::array<float, kArmJointNames.size()> places_m = {
            0, 0, kForearm_m / 2, kForearm_m, kForearm_m, kForearm_m, kForearm_m + kUpperArm_m};
        for (size_t k = 0; k < kArmJointNames.size(); ++k) {
            const int node = model->findNode(std::string(kArmJointNames[k]));
            ASSERT_GE(node, 0) << kArmJointNames[k];
            EXPECT_LT(glm::distance(glm::vec3(rest.modelFromNode[static_cast<size_t>(node)][3]),
                                    glm::vec3(0, 0, places_m[k])),
                      kNear_m);
        }
        ASSERT_EQ(model->meshes.size(), 1u);
        ASSERT_EQ(model->meshes[0].primitives.size(), 1u);
        const scene::Primitive& sleeve = model->meshes[0].primitives[0];
        EXPECT_LE(sleeve.indices.size() / 3, 3000u);
        // Half widths where it starts, inside the hand's wrist, at the hem, and at its end.
        float least_m = 1, front_m = 1, end_m = 0, behind_m = 1;
        for (const glm::vec3& p : sleeve.positions) {
            front_m = std::min(front_m, p.z), end_m = std::max(end_m, p.z);
            if (p.z < 0.1f) least_m = std::min(least_m, std::hypot(p.x, p.y));
        }
        for (const glm::vec3& p : sleeve.positions)
            if (p.z > end_m - 1e-4f) behind_m = std::min(behind_m, std::hypot(p.x, p.y));
        EXPECT_LT(front_m, 0.012f);
        EXPECT_LT(least_m, 0.0195f); // the wrist's own half height
        EXPECT_LT(behind_m, 0.001f);
        EXPECT_GT(end_m, kForearm_m + kUpperArm_m);
    }
}

} // namespace
} // namespace shoal::app
