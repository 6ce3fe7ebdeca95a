#include "engine/physics/ContactWorld.h"

#include "engine/math/Sphere.h"

#include <btBulletCollisionCommon.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace shoal::physics {

namespace {

btVector3 toBullet(glm::vec3 v) { return {v.x, v.y, v.z}; }

glm::vec3 middle(const Capsule& c) { return 0.5f * (c.a + c.b); }

auto key(const Contact& c) { return std::tuple(c.body, c.group, c.tag); }

// Holds the capsule's whole way.
Sphere around(const Capsule& from, const Capsule& to) {
    const glm::vec3 a = middle(from), b = middle(to);
    const float half = 0.5f * std::max(glm::distance(from.a, from.b), glm::distance(to.a, to.b));
    return {0.5f * (a + b), 0.5f * glm::distance(a, b) + half + to.radius};
}

bool meet(const Sphere& p, const Sphere& q) {
    const glm::vec3 apart = p.centre - q.centre;
    const float reach = p.radius + q.radius + kLift_m;
    return glm::dot(apart, apart) < reach * reach;
}

bool teleported(const Mover& m) {
    return std::max(glm::distance(m.before.a, m.after.a), glm::distance(m.before.b, m.after.b)) > kTeleport_m;
}

// Of the bone's end points' velocities, the one at a point of its core segment.
glm::vec3 velocityAt(const Mover& mover, glm::vec3 onCore) {
    const glm::vec3 along = mover.after.b - mover.after.a;
    const float squared = glm::dot(along, along);
    const float t =
        squared > 1e-12f ? std::clamp(glm::dot(onCore - mover.after.a, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::mix(mover.velocityA, mover.velocityB, t);
}

// Turns the unit vector towards the other by at most kNormalTurn_rad.
glm::vec3 turned(glm::vec3 from, glm::vec3 to) {
    const float along = glm::dot(from, to);
    const glm::vec3 across = to - from * along;
    const float length = glm::length(across);
    if (along > 0 && length <= kNormalTurn_rad) return to;
    if (length < 1e-6f) return from;
    return glm::normalize(from + across * (kNormalTurn_rad / length));
}

// Pairs are looked at one by one; Bullet would take 4 MiB for 4096 at a time.
btDefaultCollisionConstructionInfo fewPairs() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
    return info;
}

} // namespace

struct ContactWorld::Bullet {
    btDefaultCollisionConfiguration configuration{fewPairs()};
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase; // stays empty: pairs are chosen by collide()
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};
    btCapsuleShape moverShape{1, 1}, bodyShape{1, 1};
    btCollisionObject mover, body;
    std::vector<Sphere> spheres; // around the movers: scratch

    Bullet() {
        mover.setCollisionShape(&moverShape);
        body.setCollisionShape(&bodyShape);
    }

    // The way by which the body gets out of the mover soonest.
    glm::vec3 wayOut(const Capsule& mover, const Capsule& body);
    bool begin(const Mover&, const Body&, Contact&);
};

namespace {

void shapeTo(btCapsuleShape& shape, const Capsule& c) {
    shape.setMargin(c.radius); // a capsule's margin is its radius
    shape.setImplicitShapeDimensions({c.radius, 0.5f * glm::distance(c.a, c.b), c.radius});
}

// A shape whose core is the capsule's segment about its middle, along Bullet's Y.
btTransform place(const Capsule& c) {
    const glm::vec3 along = c.b - c.a;
    const float length = glm::length(along);
    btTransform world;
    world.setIdentity();
    world.setOrigin(toBullet(middle(c)));
    if (length > 1e-6f) world.setRotation(shortestArcQuat(btVector3(0, 1, 0), toBullet(along / length)));
    return world;
}

// Keeps the deepest point of a pair.
struct Deepest : btCollisionWorld::ContactResultCallback {
    bool hit = false;
    float distance = 0;
    btVector3 fromSecond{0, 1, 0}; // Bullet's normal points from its second object to its first
    const btCollisionObject* mover = nullptr;

    btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* first, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        if (!hit || p.getDistance() < distance) {
            distance = p.getDistance();
            fromSecond =
                first->getCollisionObject() == mover ? -p.m_normalWorldOnB : btVector3(p.m_normalWorldOnB);
            hit = true;
        }
        return 0;
    }
};

} // namespace

glm::vec3 ContactWorld::Bullet::wayOut(const Capsule& bone, const Capsule& flesh) {
    shapeTo(moverShape, bone);
    shapeTo(bodyShape, flesh);
    mover.setWorldTransform(place(bone));
    body.setWorldTransform(place(flesh));
    Deepest deepest;
    deepest.mover = &mover;
    world.contactPairTest(&mover, &body, deepest);
    const btVector3 n = deepest.fromSecond;
    const glm::vec3 way(n.x(), n.y(), n.z());
    const float length = glm::length(way);
    return length > 0.5f && length < 2 ? way / length : glm::vec3(0, 1, 0);
}

ContactWorld::ContactWorld() : bullet_(std::make_unique<Bullet>()) {}
ContactWorld::~ContactWorld() = default;
ContactWorld::ContactWorld(ContactWorld&&) noexcept = default;
ContactWorld& ContactWorld::operator=(ContactWorld&&) noexcept = default;

namespace {

// A pair of a mover and a body during the tick. A mover that was replaced is only looked at where it is now.
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

// A lasting contact keeps its side; its normal turns towards the line of nearest points where that is
// certain.
glm::vec3 renewedNormal(const Pair& pair, glm::vec3 normal) {
    const float distance = glm::length(pair.apart);
    if (distance <= kCoreShare * pair.radii) return normal;
    const float side = glm::dot(pair.apart, normal) < 0 ? -1.0f : 1.0f;
    return turned(normal, pair.apart * (side / distance));
}

// Depth, place and velocities at the tick's end. False: it is over.
bool complete(const Pair& pair, float dt_s, Contact& c) {
    // Beyond both radii on the far side the mover is through, and free.
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

} // namespace

// Normal and time of a contact without a past. False: the two do not touch.
bool ContactWorld::Bullet::begin(const Mover& bone, const Body& flesh, Contact& c) {
    const Pair pair(bone, flesh);
    c.fresh = true;
    const Nearest was = nearest(pair.moverFrom, pair.bodyFrom);
    const glm::vec3 start = was.onSecond - was.onFirst;
    const float room = glm::length(start);
    if (room <= pair.radii) { // inside one another, and nobody knows how
        c.normal = room > kCoreShare * pair.radii ? start / room : wayOut(pair.moverFrom, pair.bodyFrom);
        return true;
    }
    c.time = firstTouch(pair.moverFrom, bone.after, pair.bodyFrom, flesh.after);
    if (c.time > 1) return false;
    const Nearest met =
        nearest(between(pair.moverFrom, bone.after, c.time), between(pair.bodyFrom, flesh.after, c.time));
    const glm::vec3 way = met.onSecond - met.onFirst;
    c.normal = way / std::max(glm::length(way), 1e-9f); // both radii apart: never near 0
    return true;
}

void ContactWorld::collide(std::span<const Body> bodies, std::span<const Mover> movers, float dt_s,
                           std::span<const Contact> last, std::vector<Contact>& out) {
    out.clear();
    std::vector<Sphere>& spheres = bullet_->spheres;
    spheres.clear();
    for (const Mover& mover : movers)
        spheres.push_back(around(teleported(mover) ? mover.after : mover.before, mover.after));
    for (const Body& body : bodies) {
        const Sphere bodySphere = around(body.before, body.after);
        for (size_t i = 0; i < movers.size(); ++i) {
            if (!meet(spheres[i], bodySphere)) continue;
            const Pair pair(movers[i], body);
            Contact c;
            c.body = body.id;
            c.group = pair.mover.group;
            c.tag = pair.mover.tag;
            const auto before =
                std::lower_bound(last.begin(), last.end(), c,
                                 [](const Contact& l, const Contact& r) { return key(l) < key(r); });
            const bool lasted =
                before != last.end() && key(*before) == key(c) && before->lasting && !pair.jumped;
            if (lasted)
                c.normal = renewedNormal(pair, before->normal);
            else if (!bullet_->begin(pair.mover, body, c))
                continue;
            if (complete(pair, dt_s, c)) out.push_back(c);
        }
    }
    // A total order, so the result does not depend on the callers' order.
    std::sort(out.begin(), out.end(), [](const Contact& l, const Contact& r) { return key(l) < key(r); });
}

namespace {

constexpr size_t kMax = 64; // contacts looked at: two hands have 48 bones

// min |v - velocity|^2 + kSoftness |impulses|^2 so that v . n >= goal, impulses >= 0.
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

glm::vec3 pushed(glm::vec3 velocity, std::span<const Contact> contacts) {
    return solve(velocity, contacts, [](const Contact& c) { return glm::dot(c.moverVelocity, c.normal); });
}

glm::vec3 parting(std::span<const Contact> contacts) {
    const glm::vec3 velocity = solve(glm::vec3(0), contacts, [](const Contact& c) {
        if (!c.lasting) return 0.0f;
        return std::min(kPartRate_Hz * std::max(0.0f, c.depth - kPartSlop_m), kPartMax_mps);
    });
    const float speed = glm::length(velocity); // in a wedge, more than any one contact asks
    return speed > kPartMax_mps ? velocity * (kPartMax_mps / speed) : velocity;
}

} // namespace shoal::physics
