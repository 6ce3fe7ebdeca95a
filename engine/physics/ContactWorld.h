// Where moving capsules (the bones of hands) meet body capsules during one tick. Continuous in effect: each
// mover is swept in steps no longer than half the smallest body radius, so nothing fast passes through.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace shoal::physics {

// World frame, metres, seconds.

struct Capsule {
    glm::vec3 a{0}, b{0}; // ends of the core segment; may coincide (a sphere)
    float radius = 0.01f;
};

// A kinematic capsule that goes from one place to another during the tick; end points move on straight lines.
struct Mover {
    Capsule before, after;
    int group = 0; // a hand
    int tag = 0;   // a bone
};

// A body at the tick's end; it is taken to move straight at its velocity.
struct Body {
    uint32_t id = 0;
    glm::vec3 position{0};      // middle of the core segment
    glm::vec3 forward{0, 0, 1}; // unit length, along the core segment
    glm::vec3 velocity{0};
    float radius = 0.03f;
    float halfLength = 0.05f; // of the core segment
};

struct Contact {
    uint32_t body = 0;
    int group = 0;
    int tag = 0;
    glm::vec3 point{0};     // on the body's surface
    glm::vec3 normal{0};    // unit length, from the mover towards the body: the way the body is pushed
    float depth = 0;        // overlap at first touch, metres, >= 0
    float closingSpeed = 0; // of the mover against the body along the normal, m/s, >= 0
    float time = 0;         // of first touch, 0 to 1 within the tick
};

class ContactWorld {
  public:
    ContactWorld();
    ~ContactWorld();
    ContactWorld(ContactWorld&&) noexcept;
    ContactWorld& operator=(ContactWorld&&) noexcept;

    // Replaces out by the first touch of every (body, group, tag), sorted by body, group, tag. Deterministic:
    // a function of its arguments alone. A mover that goes farther than kTeleport_m is only tested at its
    // end.
    void collide(std::span<const Body>, std::span<const Mover>, float dt_s, std::vector<Contact>& out);

    static constexpr float kTeleport_m = 1.5f;

  private:
    struct Bullet;
    std::unique_ptr<Bullet> bullet_;
};

// Distance between the core segments' surfaces, metres; negative when they overlap. Ericson 2005, "Real-Time
// Collision Detection", 5.1.9.
float separation(const Capsule&, const Capsule&);

} // namespace shoal::physics
