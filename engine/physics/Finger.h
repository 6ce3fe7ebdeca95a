// A finger that closes around a body it cannot enter. What a device sees of a hand goes through the fish,
// since there is no fish; what grips and is shown is this finger. See ContactModel.h, step 4.
#pragma once

#include "engine/physics/Capsule.h"

#include <glm/gtc/quaternion.hpp>

#include <array>

namespace shoal::physics {

constexpr int kFingerJoints = 5; // metacarpal, three knuckles, tip; the thumb has one less

struct Finger {
    std::array<glm::vec3, kFingerJoints> joints{}; // world, from the metacarpal to the tip
    std::array<float, kFingerJoints> radii{};      // of the bone that ends there; the first is unused
    std::array<glm::quat, kFingerJoints> turned{}; // from the finger given to the one wrapped, by bone's end
    std::array<bool, kFingerJoints> touches{};     // the bone that ends there rests on the body
    int count = kFingerJoints;                     // of joints
};

// The finger, straightened, then bent knuckle by knuckle as it was given until what lies beyond the knuckle
// touches the body; the metacarpal stays. Bones keep their lengths.
Finger wrapped(const Finger& given, const Capsule& body);

} // namespace shoal::physics
