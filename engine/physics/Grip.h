// Fingers that close around a body, and the test whether they hold it against a force; see ContactModel.h,
// steps 4 and 5. Newtons, metres.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/scene/HandPose.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <span>

namespace shoal::physics {

// A finger that closes around a body which it cannot enter. A device sees the player's real finger, which
// nothing stops; this finger is shown, and grips.
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

// One place where a hand presses on a body.
struct Press {
    glm::vec3 normal{0}; // unit, into the body
    float force_N = 0;   // along the normal it can give anything from 0 to this, with friction across
};

struct Hold {
    float margin_N = 0; // so much more force from the worst side would still be borne; below 0: it slips
    glm::vec3 gives{0}; // unit: the way in which it slips, or would slip first
};

// asked_N: the force from outside that the presses must balance. The directions are sampled every 18 degrees
// and refined.
Hold hold(std::span<const Press>, glm::vec3 asked_N);

// Of a contact pressed in so deep.
float pressForce_N(float depth_m);

// Of a body with that capsule.
float mass_kg(float radius_m, float halfLength_m);

} // namespace shoal::physics
