// Fingers that close around a body, and a test whether they hold it against a force; see ContactModel.h,
// steps 4 and 5. Newtons, metres.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/scene/HandPose.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <span>

namespace shoal::physics {

// A finger that closes around a body without entering it. A device sees the player's real finger, which
// nothing stops; this finger is shown, and grips.
struct Finger {
    std::array<glm::vec3, hands::kMaxFingerJoints> joints{}; // world, from the metacarpal to the tip
    std::array<float, hands::kMaxFingerJoints>
        radii{}; // radius of the bone that ends there, from the second on
    std::array<glm::quat, hands::kMaxFingerJoints> turned{}; // rotation of that bone from the given finger's
    std::array<bool, hands::kMaxFingerJoints> touches{}; // whether the bone that ends there rests on the body
    int count = hands::kMaxFingerJoints;                 // number of joints
};

// Returns the finger straightened, then bent as given, knuckle by knuckle, until the part beyond the knuckle
// touches the body; the metacarpal stays. Bones keep their lengths.
Finger wrapped(const Finger& given, const Capsule& body);

// A contact at which a hand presses on a body.
struct Press {
    glm::vec3 normal{0}; // unit, into the body
    float force_N = 0;   // greatest force along the normal: it pushes with 0 to this, with friction across
};

struct Hold {
    float margin_N = 0; // additional force from the worst side that would still be held; below 0: it slips
    glm::vec3 gives{0}; // unit: the direction in which it slips, or would slip first
};

// Tests a grip. asked_N: the external force that the presses must balance. Directions are sampled every 18
// degrees and refined.
Hold hold(std::span<const Press>, glm::vec3 asked_N);

// Returns the force of a contact of this depth.
float pressForce_N(float depth_m);

// Returns the mass of a body with that capsule.
float mass_kg(float radius_m, float halfLength_m);

} // namespace shoal::physics
