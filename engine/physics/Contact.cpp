#include "engine/physics/Contact.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace shoal::physics {

namespace {

auto key(const Contact& c) { return std::tuple(c.body, c.group, c.tag); }

bool teleported(const Mover& m) {
    return std::max(glm::distance(m.before.a, m.after.a), glm::distance(m.before.b, m.after.b)) > kTeleport_m;
}

// Returns the bone's velocity at a point of its core segment, interpolated between its end points'.
glm::vec3 velocityAt(const Mover& mover, glm::vec3 onCore) {
    const glm::vec3 along = mover.after.b - mover.after.a;
    const float squared = glm::dot(along, along);
    const float t =
        squared > 1e-12f ? std::clamp(glm::dot(onCore - mover.after.a, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::mix(mover.velocityA, mover.velocityB, t);
}

// Rotates a unit vector towards another by at most kNormalTurn_rad.
glm::vec3 turned(glm::vec3 from, glm::vec3 to) {
    const float along = glm::dot(from, to);
    const glm::vec3 across = to - from * along;
    const float length = glm::length(across);
    if (along > 0 && length <= kNormalTurn_rad) return to;
    if (length < 1e-6f) return from;
    return glm::normalize(from + across * (kNormalTurn_rad / length));
}

// A pair of a mover and a body during the tick. A mover that was teleported is only tested at its new place.
struct Pair {
    const Mover& mover;
    const Body& body;
    bool jumped;
    const Capsule &moverFrom, &bodyFrom;
    float radii;
    Nearest at; // at the tick's end
    glm::vec3 apart;

    Pair(const Mover& m, const Body& b)
        : mover(m), body(b), jumped(teleported(m)), moverFrom(jumped ? m.after : m.before),
          bodyFrom(jumped ? b.after : b.before), radii(m.after.radius + b.after.radius),
          at(nearest(m.after, b.after)), apart(at.onSecond - at.onFirst) {}
};

// Returns the direction of the shortest separation of two capsules whose axes cross: at right angles to both
// axes, or, if these are parallel, to the longer one. The opposite direction is as short.
glm::vec3 wayOut(const Capsule& first, const Capsule& second) {
    const glm::vec3 d1 = first.b - first.a, d2 = second.b - second.a;
    const glm::vec3 longer = glm::dot(d1, d1) > glm::dot(d2, d2) ? d1 : d2, across = glm::cross(d1, d2);
    if (glm::length(across) > 1e-4f * glm::dot(longer, longer)) return glm::normalize(across);
    const glm::vec3 level =
        glm::cross(longer, std::abs(longer.y) < std::abs(longer.x) ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
    return glm::dot(level, level) > 0 ? glm::normalize(level) : glm::vec3(0, 1, 0);
}

// Returns the normal of a lasting contact: it keeps its side, and turns towards the line of nearest points
// unless the axes are so near that this line is uncertain.
glm::vec3 renewedNormal(const Pair& pair, glm::vec3 normal) {
    const float distance = glm::length(pair.apart);
    if (distance <= kCoreShare * pair.radii) return normal;
    const float side = glm::dot(pair.apart, normal) < 0 ? -1.0f : 1.0f;
    return turned(normal, pair.apart * (side / distance));
}

// Sets depth, place and velocities at the tick's end. Returns false if the contact is over.
bool complete(const Pair& pair, float dt_s, Contact& c) {
    // A mover that is both radii beyond the axis on the far side has passed through: the contact is over.
    const float along = glm::dot(pair.apart, c.normal);
    c.lasting = glm::length(pair.apart) < pair.radii + kLift_m && along > -pair.radii;
    if (!c.lasting && !c.fresh) return false;
    c.depth = std::clamp(pair.radii - along, 0.0f, 2 * pair.radii);
    c.point = pair.at.onSecond - c.normal * pair.body.after.radius;
    c.moverVelocity = pair.jumped ? glm::vec3(0) : velocityAt(pair.mover, pair.at.onFirst);
    const glm::vec3 way =
        pair.jumped ? glm::vec3(0) : (middle(pair.mover.after) - middle(pair.moverFrom)) / dt_s;
    c.closingSpeed = std::max(0.0f, glm::dot(way - pair.body.velocity, c.normal));
    return true;
}

// Sets normal and time of a new contact. Returns false if the two do not touch.
bool begin(const Pair& pair, Contact& c) {
    const Capsule &bone = pair.mover.after, &flesh = pair.body.after;
    c.fresh = true;
    const Nearest was = nearest(pair.moverFrom, pair.bodyFrom);
    const glm::vec3 start = was.onSecond - was.onFirst;
    const float room = glm::length(start);
    if (room <= pair.radii) { // they already overlap, with unknown history
        c.normal = room > kCrossed_m ? start / room : wayOut(pair.moverFrom, pair.bodyFrom);
        return true;
    }
    c.time = firstTouch(pair.moverFrom, bone, pair.bodyFrom, flesh);
    if (c.time > 1) return false;
    const Nearest met = nearest(between(pair.moverFrom, bone, c.time), between(pair.bodyFrom, flesh, c.time));
    const glm::vec3 way = met.onSecond - met.onFirst;
    c.normal = way / std::max(glm::length(way), 1e-9f); // about the sum of the radii, never near 0
    return true;
}

constexpr size_t kMax = 64; // contacts considered: two hands have 48 bones

// Solves min |v - velocity|^2 + kSoftness |impulses|^2 so that v . n >= goal, impulses >= 0.
template <class Goal> glm::vec3 solve(glm::vec3 velocity, std::span<const Contact> contacts, Goal goal) {
    std::array<float, kMax> impulse{};
    const size_t count = std::min(contacts.size(), kMax);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool done = true;
        for (size_t i = 0; i < count; ++i) {
            const glm::vec3 n = contacts[i].normal;
            const float lacks = goal(contacts[i]) - glm::dot(velocity, n) - kSoftness * impulse[i];
            const float next = std::max(0.0f, impulse[i] + lacks / (1 + kSoftness));
            if (next == impulse[i]) continue;
            velocity += n * (next - impulse[i]);
            impulse[i] = next;
            done = false;
        }
        if (done) break;
    }
    return velocity;
}

} // namespace

std::optional<Contact> contactOf(const Mover& mover, const Body& body, float dt_s,
                                 std::span<const Contact> last) {
    const Pair pair(mover, body);
    Contact c{.body = body.id, .group = mover.group, .tag = mover.tag};
    const auto before = std::ranges::lower_bound(last, key(c), {}, key);
    const bool lasted = before != last.end() && key(*before) == key(c) && before->lasting && !pair.jumped;
    if (lasted)
        c.normal = renewedNormal(pair, before->normal);
    else if (!begin(pair, c))
        return {};
    return complete(pair, dt_s, c) ? std::optional(c) : std::nullopt;
}

glm::vec3 pushed(glm::vec3 velocity, std::span<const Contact> contacts) {
    return solve(velocity, contacts, [](const Contact& c) { return glm::dot(c.moverVelocity, c.normal); });
}

glm::vec3 separating(std::span<const Contact> contacts) {
    const glm::vec3 velocity = solve(glm::vec3(0), contacts, [](const Contact& c) {
        if (!c.lasting) return 0.0f;
        return std::min(kPartRate_Hz * std::max(0.0f, c.depth - kPartSlop_m), kPartMax_mps);
    });
    const float speed = glm::length(velocity); // in a wedge it exceeds what one contact asks
    return speed > kPartMax_mps ? velocity * (kPartMax_mps / speed) : velocity;
}

} // namespace shoal::physics
