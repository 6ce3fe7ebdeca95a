// The physics world, built on Bullet 3, holds everything that can touch during a tick. It finds the contacts
// of hands with bodies, and moves loose bodies, which drift in water and knock against everything else.
//
// The world keeps memory, but no state: each call copies bodies in and results out, and no manifold, impulse
// or order survives the call. Equal arguments give equal results on every machine, by scalar solver rows, no
// warm starting, no random order, manifolds sorted by id, and none of the functions of Bullet that call the C
// library's trigonometry. The world's memory grows at first; then no call allocates.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/physics/Contact.h"

#include <glm/gtc/quaternion.hpp>

#include <functional>
#include <span>
#include <vector>

namespace shoal::physics {

// All types here are in the world frame, metres and seconds.

// A rigid body that nobody steers: a capsule along its own Z in water.
struct LooseBody {
    uint32_t id = 0; // differs from those of all bodies
    float radius = 0.03f, half = 0.01f;
    float density_kgpm3 = 2600;
    float drag = 0.5f;   // coefficient, on the mean projected area
    float bounce = 0.3f; // coefficient of restitution on rock
    glm::vec3 position{0}, velocity{0};
    glm::vec3 spin{0}; // angular velocity, rad/s
    glm::quat worldFromBody{1, 0, 0, 0};
};

// Returns the speed that water lets a loose body keep: drag and buoyancy over a time, see World.cpp.
glm::vec3 inWater(const LooseBody&, float dt_s);

constexpr uint32_t kGroundId = ~0u;

// A loose body meets another body, or the ground.
struct Knock {
    uint32_t loose = 0, other = kGroundId; // `other` may be loose, too; then it has the greater id
    glm::vec3 point{0};
    float closing_mps = 0; // > 0
};

// Surfaces at rest. triangles() calls `visit` for each triangle that may reach into the box.
struct Ground {
    using Visit = std::function<void(glm::vec3, glm::vec3, glm::vec3)>;
    std::function<void(glm::vec3 low, glm::vec3 high, const Visit& visit)> triangles;
    float friction = 0;
};

class World {
  public:
    World();

    // Writes to out the contacts of bones with bodies in this tick, at most one for each (body, group, tag),
    // sorted by these. last: the contacts of the previous tick. The result depends only on the arguments, not
    // on the order of bodies and movers. A mover that goes farther than kTeleport_m is only tested at its
    // end. Bodies and movers that are not finite touch nothing.
    void touch(std::span<const Body>, std::span<const Mover>, float dt_s, std::span<const Contact> last,
               std::vector<Contact>& out);

    // Moves loose bodies by a tick. They meet one another, the ground, and bodies whose motion is given.
    // Writes to out the hardest knock of each pair, sorted by ids.
    void move(std::span<LooseBody>, std::span<const Body>, const Ground&, float dt_s,
              std::vector<Knock>& out);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::physics
