// Capsules: the distance between two, and the time of first touch of two that move.
#pragma once

#include <glm/vec3.hpp>

namespace shoal::physics {

// World frame, metres.

struct Capsule {
    glm::vec3 a{0}, b{0}; // ends of the core segment; may coincide (a sphere)
    float radius = 0.01f;
};

inline glm::vec3 middle(const Capsule& c) { return 0.5f * (c.a + c.b); }

// Nearest points of two capsules' core segments. Ericson 2005, "Real-Time Collision Detection", 5.1.9.
struct Nearest {
    glm::vec3 onFirst{0}, onSecond{0};
};
Nearest nearest(const Capsule&, const Capsule&);

// Returns the distance between the surfaces; negative if they overlap.
float separation(const Capsule&, const Capsule&);

// Interpolates the end points between two capsules; t 0 to 1.
Capsule between(const Capsule& from, const Capsule& to, float t);

// Returns the fraction of the motion, 0 to 1, at which two capsules that start apart first touch (come within
// kTouchGap_m); above 1 if they do not. By conservative advancement, see ContactModel.h.
float firstTouch(const Capsule& from, const Capsule& to, const Capsule& otherFrom, const Capsule& otherTo);

} // namespace shoal::physics
