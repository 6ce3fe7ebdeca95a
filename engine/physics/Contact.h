// The contact of a bone of a hand with a body during one tick, which lasts from tick to tick, and how it
// pushes; see ContactModel.h, steps 1 to 3. World.h finds the pairs.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/physics/ContactModel.h"

#include <cstdint>
#include <optional>
#include <span>

namespace shoal::physics {

// All types here are in the world frame, metres and seconds.

// A kinematic capsule that moves from one place to another during the tick.
struct Mover {
    Capsule before, after;
    glm::vec3 velocityA{0}, velocityB{0}; // velocities of its ends, for pushing; smoother than its motion
    int group = 0;                        // index of the hand
    int tag = 0;                          // index of the bone
};

struct Body {
    uint32_t id = 0;
    Capsule before, after; // over the same tick
    glm::vec3 velocity{0};
};

struct Contact {
    uint32_t body = 0;
    int group = 0;
    int tag = 0;
    bool fresh = false;         // it began in this tick
    bool lasting = false;       // it still touches at the tick's end
    glm::vec3 point{0};         // on the body's surface
    glm::vec3 normal{0};        // unit, from the mover towards the body: the direction of the push
    float depth = 0;            // penetration along the normal at the tick's end, metres
    float closingSpeed = 0;     // speed of the mover relative to the body along the normal, m/s, >= 0
    glm::vec3 moverVelocity{0}; // velocity of the mover at the contact, m/s
    float time = 0;             // time of first touch, 0 to 1 within the tick; 0 for lasting contacts
};

// Returns the contact of the two in this tick, if any. last: all contacts of the previous tick, sorted by
// body, group and tag. A mover that goes farther than kTeleport_m is only tested at its end.
std::optional<Contact> contactOf(const Mover&, const Body&, float dt_s, std::span<const Contact> last);

// The functions below compute the velocity of a free body after contacts with hands; see ContactModel.h, step
// 3. All contacts must be of the same body.

// Returns the velocity after the contacts. If they do not contradict one another, it is along each normal at
// least the mover's, but for kSoftness. A mover at rest never makes the body faster.
glm::vec3 pushed(glm::vec3 velocity, std::span<const Contact>);

// Returns the velocity that separates overlapping capsules, to be used for one tick and not kept. At most
// kPartMax_mps where contacts agree, and almost 0 where they contradict one another.
glm::vec3 separating(std::span<const Contact>);

} // namespace shoal::physics
