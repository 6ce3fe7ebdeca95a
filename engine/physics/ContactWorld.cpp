#include "engine/physics/ContactWorld.h"

#include <btBulletCollisionCommon.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace shoal::physics {

namespace {

btVector3 toBullet(glm::vec3 v) { return {v.x, v.y, v.z}; }

glm::vec3 middle(const Capsule& c) { return 0.5f * (c.a + c.b); }

auto key(const Contact& c) { return std::tuple(c.body, c.group, c.tag); }

// A ball around the capsule's whole way.
struct Ball {
    glm::vec3 centre;
    float radius;
};

Ball around(const Capsule& from, const Capsule& to) {
    const glm::vec3 a = middle(from), b = middle(to);
    const float half = 0.5f * std::max(glm::distance(from.a, from.b), glm::distance(to.a, to.b));
    return {0.5f * (a + b), 0.5f * glm::distance(a, b) + half + to.radius};
}

bool meet(const Ball& p, const Ball& q) {
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
    std::vector<Ball> balls; // around the movers: scratch

    Bullet() {
        mover.setCollisionShape(&moverShape);
        body.setCollisionShape(&bodyShape);
    }

    // The way by which the body gets out of the mover soonest.
    glm::vec3 wayOut(const Capsule& mover, const Capsule& body);
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

Mover moving(const Capsule& before, const Capsule& after, float dt_s, int group, int tag) {
    return {before, after, (after.a - before.a) / dt_s, (after.b - before.b) / dt_s, group, tag};
}

void ContactWorld::collide(std::span<const Body> bodies, std::span<const Mover> movers, float dt_s,
                           std::span<const Contact> last, std::vector<Contact>& out) {
    out.clear();
    std::vector<Ball>& balls = bullet_->balls;
    balls.clear();
    for (const Mover& mover : movers)
        balls.push_back(around(teleported(mover) ? mover.after : mover.before, mover.after));
    for (const Body& body : bodies) {
        const Ball bodyBall = around(body.before, body.after);
        for (size_t i = 0; i < movers.size(); ++i) {
            if (!meet(balls[i], bodyBall)) continue;
            const Mover& mover = movers[i];
            const bool jumped = teleported(mover);
            const Capsule& from = jumped ? mover.after : mover.before;

            Contact c;
            c.body = body.id;
            c.group = mover.group;
            c.tag = mover.tag;
            const auto before =
                std::lower_bound(last.begin(), last.end(), c,
                                 [](const Contact& l, const Contact& r) { return key(l) < key(r); });
            const bool lasted = before != last.end() && key(*before) == key(c) && before->lasting && !jumped;

            const float radii = mover.after.radius + body.after.radius;
            const Nearest at = nearest(mover.after, body.after);
            const glm::vec3 apart = at.onSecond - at.onFirst;
            const float distance = glm::length(apart);
            if (lasted) {
                c.normal = before->normal;
                if (distance > kCoreShare * radii) {
                    const float side = glm::dot(apart, c.normal) < 0 ? -1.0f : 1.0f;
                    c.normal = turned(c.normal, apart * (side / distance));
                }
            } else {
                c.fresh = true;
                const Capsule& bodyFrom = jumped ? body.after : body.before;
                const Nearest was = nearest(from, bodyFrom);
                const glm::vec3 start = was.onSecond - was.onFirst;
                const float room = glm::length(start);
                if (room <= radii) { // inside one another, and nobody knows how
                    c.normal = room > kCoreShare * radii ? start / room : bullet_->wayOut(from, bodyFrom);
                } else {
                    c.time = firstTouch(from, mover.after, bodyFrom, body.after);
                    if (c.time > 1) continue;
                    const Nearest met =
                        nearest(between(from, mover.after, c.time), between(bodyFrom, body.after, c.time));
                    const glm::vec3 way = met.onSecond - met.onFirst;
                    c.normal = way / std::max(glm::length(way), 1e-9f); // both radii apart: never near 0
                }
            }
            // Beyond both radii on the far side the mover is through, and free.
            const float along = glm::dot(apart, c.normal);
            c.lasting = distance < radii + kLift_m && along > -radii;
            if (!c.lasting && !c.fresh) continue;
            c.depth = std::clamp(radii - along, 0.0f, 2 * radii);
            c.point = at.onSecond - c.normal * body.after.radius;
            c.moverVelocity = jumped ? glm::vec3(0) : velocityAt(mover, at.onFirst);
            const glm::vec3 way = jumped ? glm::vec3(0) : (middle(mover.after) - middle(from)) / dt_s;
            c.closingSpeed = std::max(0.0f, glm::dot(way - body.velocity, c.normal));
            out.push_back(c);
        }
    }
    // A total order, so the result does not depend on the callers' order.
    std::sort(out.begin(), out.end(), [](const Contact& l, const Contact& r) { return key(l) < key(r); });
}

} // namespace shoal::physics
