// Pose of a finger that closes around a body which it cannot enter. A device sees the player's real finger,
// which nothing stops; this finger is shown, and grips. See ContactModel.h, step 4.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/scene/HandPose.h"

#include <glm/gtc/quaternion.hpp>

#include <array>

namespace shoal::physics {

struct Finger {
    std::array<glm::vec3, hands::kMaxFingerJoints> joints{}; // world, from the metacarpal to the tip
    std::array<float, hands::kMaxFingerJoints> radii{}; // of the bone that ends there; the first is unused
    std::array<glm::quat, hands::kMaxFingerJoints>
        turned{}; // from the finger given to the one wrapped, by bone's end
    std::array<bool, hands::kMaxFingerJoints> touches{}; // the bone that ends there rests on the body
    int count = hands::kMaxFingerJoints;                 // of joints
};

// The finger, straightened, then bent knuckle by knuckle as it was given until what lies beyond the knuckle
// touches the body; the metacarpal stays. Bones keep their lengths.
Finger wrapped(const Finger& given, const Capsule& body);

} // namespace shoal::physics
