// An arm is posed between a tracked wrist and a shoulder that is estimated from the head. It is for the
// picture only: the simulation does not know it.
#pragma once

#include "engine/scene/HandPose.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <string_view>

namespace shoal::app {

constexpr float kForearm_m = 0.27f, kUpperArm_m = 0.30f; // equal to content/make/models/arms.py

// Joints of content/models/arm_*.glb. At rest the arm lies along +Z behind the wrist, back of the hand up.
enum class ArmJoint { Wrist, ForearmEnd, ForearmMiddle, Forearm, Elbow, UpperArmEnd, UpperArm };
constexpr std::array<std::string_view, 7> kArmJointNames = {
    "wrist", "forearm_end", "forearm_middle", "forearm", "elbow", "upper_arm_end", "upper_arm"};

// World from joint matrices, by ArmJoint; rotations and translations only.
using ArmPose = std::array<glm::mat4, kArmJointNames.size()>;

struct Head {
    glm::vec3 positionWorld{0}; // between the eyes
    glm::quat worldFromView{1, 0, 0, 0};
};

// Returns the shoulder's place. It follows the head's yaw, and its pitch and roll as far as keeps it out of
// any perspective picture: behind the plane through the eyes, and aside of the view direction.
glm::vec3 shoulderWorld(hands::Side side, const Head& head);

// Poses the arm; the wrist stays where it is. If it is farther from the shoulder than the arm is long, both
// bones are scaled by one factor. towardsElbow: direction from the wrist, world frame, if a tracker gives it;
// its length is its weight, from 1 down to 0, where the elbow hangs loosely. It decides only to which side of
// the line from wrist to shoulder the elbow bends.
ArmPose poseArm(hands::Side side, const hands::Joint& wristWorld, const Head& head,
                const glm::vec3& towardsElbow = glm::vec3(0));

// Returns the factor by which the bones are stretched, at least 1.
float stretchOf(const ArmPose& arm);

} // namespace shoal::app
