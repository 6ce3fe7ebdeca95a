// Arms between tracked wrists and shoulders that are estimated from the head. For the picture only: nothing
// of it is in the simulation.
#pragma once

#include "engine/scene/HandPose.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <string_view>

namespace shoal::app {

constexpr float kForearm_m = 0.27f, kUpperArm_m = 0.30f; // as content/make/models/arms.py has them

// Joints of content/models/arm_*.glb. At rest the arm lies along +Z behind the wrist, the back of the hand
// up.
enum class ArmJoint { Wrist, ForearmEnd, ForearmMiddle, Forearm, Elbow, UpperArmEnd, UpperArm };
constexpr std::array<std::string_view, 7> kArmJointNames = {
    "wrist", "forearm_end", "forearm_middle", "forearm", "elbow", "upper_arm_end", "upper_arm"};

// World from joint, by ArmJoint; rotations and translations only.
using ArmPose = std::array<glm::mat4, kArmJointNames.size()>;

struct Head {
    glm::vec3 positionWorld{0}; // between the eyes
    glm::quat worldFromView{1, 0, 0, 0};
};

// Follows the head's yaw, and of its pitch and roll as much as keeps the shoulder out of any perspective
// picture: it never lies ahead of the plane through the eyes, nor close to where they look.
glm::vec3 shoulderWorld(hands::Side side, const Head& head);

// The wrist stays where it is. Where it is farther from the shoulder than the arm is long, both bones are
// stretched alike. towardsElbow: from the wrist, world frame, where a tracker gives it; of length 1, shorter
// where it is trusted less, 0 where none does: then the elbow hangs loosely. Shoulder and lengths of the
// bones stay, so it decides to which side of the line from wrist to shoulder the elbow stands off.
ArmPose poseArm(hands::Side side, const hands::Joint& wristWorld, const Head& head,
                const glm::vec3& towardsElbow = glm::vec3(0));

// Of the bones, from 1.
float stretchOf(const ArmPose& arm);

} // namespace shoal::app
