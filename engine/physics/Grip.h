// Test whether contacts hold a body against a force, after Ferrari and Canny; see ContactModel.h, step 5.
// Newtons, metres.
#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace shoal::physics {

// One place where a hand presses on a body.
struct Press {
    glm::vec3 normal{0}; // unit, into the body
    float force_N = 0;   // along the normal it can give anything from 0 to this, with friction across
};

struct Hold {
    float margin_N = 0;  // so much more force from the worst side would still be borne; below 0: it slips
    glm::vec3 gives{0};  // unit: the way in which it slips, or would slip first
    float squeeze_N = 0; // sum of the forces
};

// asked_N: the force from outside that the presses must balance. The directions are sampled every 18 degrees
// and refined.
Hold hold(std::span<const Press>, glm::vec3 asked_N);

// Of a contact pressed in so deep.
float pressForce_N(float depth_m);

// Of a body with that capsule.
float mass_kg(float radius_m, float halfLength_m);

} // namespace shoal::physics
