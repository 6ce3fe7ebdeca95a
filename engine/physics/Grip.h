// Closes fingers around a body, and tests whether they hold it against a force; see ContactModel.h, steps 4
// and 5. Newtons, metres.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/scene/HandPose.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <span>

namespace shoal::physics {

// A finger that closes around a body without penetrating it. A device tracks the player's real finger, which
// nothing stops; this finger is drawn instead of it, and grips.
struct Finger {
    std::array<glm::vec3, hands::kMaxFingerJoints> joints{}; // world, from the metacarpal to the tip
    std::array<float, hands::kMaxFingerJoints>
        radii{}; // radius of the bone that ends at the joint; not for the first
    std::array<glm::quat, hands::kMaxFingerJoints> turned{}; // rotation of that bone from the given finger's
    std::array<bool, hands::kMaxFingerJoints> touches{};     // whether that bone rests on the body
    int count = hands::kMaxFingerJoints;                     // number of joints
};

// Returns the finger straightened, then bent as given, knuckle by knuckle, until the part beyond the knuckle
// touches the body; the metacarpal stays. Bones keep their lengths.
Finger wrapped(const Finger& given, const Capsule& body);

// A contact at which a hand presses on a body.
struct Press {
    glm::vec3 normal{0}; // unit, into the body
    float force_N = 0;   // maximum of its force along the normal; friction acts across the normal
};

struct Hold {
    float margin_N = 0; // additional force that it bears in the worst direction; negative if it slips
    glm::vec3 gives{0}; // unit direction in which it slips, or would slip first
};

// Tests a grip. asked_N: the force that the presses must balance. The worst direction is found among samples
// about every 18 degrees, then refined.
Hold hold(std::span<const Press>, glm::vec3 asked_N);

// Returns the force of a contact of this depth.
float pressForce_N(float depth_m);

// Returns the mass of a body with that capsule.
float mass_kg(float radius_m, float halfLength_m);

} // namespace shoal::physics
