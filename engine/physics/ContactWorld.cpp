#include "engine/physics/ContactWorld.h"

#include <btBulletCollisionCommon.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::physics {

namespace {

btVector3 toBullet(glm::vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

glm::vec3 middle(const Capsule& c) { return 0.5f * (c.a + c.b); }

Capsule between(const Capsule& from, const Capsule& to, float t) {
    return {glm::mix(from.a, to.a, t), glm::mix(from.b, to.b, t), to.radius};
}

Capsule bodyAt(const Body& body, float untilEnd_s) {
    const glm::vec3 centre = body.position - body.velocity * untilEnd_s;
    return {centre - body.forward * body.halfLength, centre + body.forward * body.halfLength, body.radius};
}

// A shape whose core is the capsule's segment about its middle, along Bullet's Y, turned by place().
btTransform place(const Capsule& c) {
    const glm::vec3 along = c.b - c.a;
    const float length = glm::length(along);
    btTransform world;
    world.setIdentity();
    world.setOrigin(toBullet(middle(c)));
    if (length > 1e-6f) {
        const btVector3 y = toBullet(along / length);
        const btVector3 pick = std::fabs(y.x()) < 0.7f ? btVector3(1, 0, 0) : btVector3(0, 1, 0);
        const btVector3 x = y.cross(pick).normalized();
        const btVector3 z = x.cross(y);
        world.setBasis(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()));
    }
    return world;
}

// Keeps the deepest point of a pair.
struct Deepest : btCollisionWorld::ContactResultCallback {
    bool hit = false;
    btManifoldPoint point;
    bool mover0 = false;
    const btCollisionObject* mover = nullptr;

    btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* first, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        if (!hit || p.getDistance() < point.getDistance()) {
            point = p;
            mover0 = first->getCollisionObject() == mover;
            hit = true;
        }
        return 0;
    }
};

} // namespace

struct ContactWorld::Bullet {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase; // stays empty: pairs are chosen by collide()
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};
    btCapsuleShape moverShape{1, 1}, bodyShape{1, 1};
    btCollisionObject mover, body;

    Bullet() {
        mover.setCollisionShape(&moverShape);
        body.setCollisionShape(&bodyShape);
    }

    static void shapeTo(btCapsuleShape& shape, const Capsule& c) {
        shape.setMargin(c.radius); // a capsule's margin is its radius
        shape.setImplicitShapeDimensions({c.radius, 0.5f * glm::length(c.b - c.a), c.radius});
    }

    // First touch of the pair in the tick, if there is one.
    bool firstTouch(const Body&, const Mover&, float dt_s, Contact& out);
};

bool ContactWorld::Bullet::firstTouch(const Body& fish, const Mover& hand, float dt_s, Contact& out) {
    const float travelA = glm::distance(hand.before.a, hand.after.a);
    const float travelB = glm::distance(hand.before.b, hand.after.b);
    const bool teleported = std::max(travelA, travelB) > kTeleport_m;
    const float travel = teleported ? 0 : std::max(travelA, travelB) + glm::length(fish.velocity) * dt_s;

    // Bounding spheres of the whole sweep: most pairs end here.
    const Capsule& from = teleported ? hand.after : hand.before;
    const Capsule fishEnd = bodyAt(fish, 0);
    const float apart = glm::distance(0.5f * (middle(from) + middle(hand.after)), fish.position);
    const float handBound = 0.5f * glm::distance(hand.after.a, hand.after.b) + hand.after.radius;
    if (apart > handBound + fish.halfLength + fish.radius + travel + 0.01f) return false;

    // Half the thinner radius a step: the deepest a first touch can be overlooked is less than that radius.
    const float stride = 0.5f * std::min(fish.radius, 0.02f);
    const int steps = std::clamp(static_cast<int>(std::ceil(travel / stride)), 1, 512);
    for (int i = 1; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        const Capsule bone = between(from, hand.after, t);
        const Capsule flesh = i == steps ? fishEnd : bodyAt(fish, (1 - t) * dt_s);
        if (separation(bone, flesh) > 0) continue;

        shapeTo(moverShape, bone);
        shapeTo(bodyShape, flesh);
        mover.setWorldTransform(place(bone));
        body.setWorldTransform(place(flesh));
        Deepest deepest;
        deepest.mover = &mover;
        world.contactPairTest(&mover, &body, deepest);
        if (!deepest.hit) continue;
        // Bullet's normal points from its second object to its first.
        const btVector3 normalOnSecond = deepest.point.m_normalWorldOnB;
        out.normal = fromBullet(deepest.mover0 ? -normalOnSecond : normalOnSecond);
        out.point = fromBullet(deepest.mover0 ? deepest.point.getPositionWorldOnB()
                                              : deepest.point.getPositionWorldOnA());
        out.depth = std::max(0.0f, -static_cast<float>(deepest.point.getDistance()));
        const glm::vec3 handVelocity =
            teleported ? glm::vec3(0) : (middle(hand.after) - middle(hand.before)) / dt_s;
        out.closingSpeed = std::max(0.0f, glm::dot(handVelocity - fish.velocity, out.normal));
        out.time = t;
        out.body = fish.id;
        out.group = hand.group;
        out.tag = hand.tag;
        return true;
    }
    return false;
}

ContactWorld::ContactWorld() : bullet_(std::make_unique<Bullet>()) {}
ContactWorld::~ContactWorld() = default;
ContactWorld::ContactWorld(ContactWorld&&) noexcept = default;
ContactWorld& ContactWorld::operator=(ContactWorld&&) noexcept = default;

void ContactWorld::collide(std::span<const Body> bodies, std::span<const Mover> movers, float dt_s,
                           std::vector<Contact>& out) {
    out.clear();
    Contact contact;
    for (const Body& body : bodies)
        for (const Mover& mover : movers)
            if (bullet_->firstTouch(body, mover, dt_s, contact)) out.push_back(contact);
    // By insertion nearly sorted; a total order, so the result does not depend on the callers' order.
    std::sort(out.begin(), out.end(), [](const Contact& l, const Contact& r) {
        if (l.body != r.body) return l.body < r.body;
        if (l.group != r.group) return l.group < r.group;
        return l.tag < r.tag;
    });
}

float separation(const Capsule& p, const Capsule& q) {
    const glm::vec3 d1 = p.b - p.a, d2 = q.b - q.a, r = p.a - q.a;
    const float a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r);
    constexpr float kPoint = 1e-12f; // squared length of a segment that counts as a point
    float s = 0, t = 0;
    if (a <= kPoint && e > kPoint) {
        t = std::clamp(f / e, 0.0f, 1.0f);
    } else if (a > kPoint) {
        const float c = glm::dot(d1, r);
        if (e <= kPoint) {
            s = std::clamp(-c / a, 0.0f, 1.0f);
        } else {
            const float b = glm::dot(d1, d2);
            const float denominator = a * e - b * b;
            if (denominator > kPoint) s = std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f);
            t = (b * s + f) / e;
            if (t < 0) {
                t = 0;
                s = std::clamp(-c / a, 0.0f, 1.0f);
            } else if (t > 1) {
                t = 1;
                s = std::clamp((b - c) / a, 0.0f, 1.0f);
            }
        }
    }
    return glm::distance(p.a + d1 * s, q.a + d2 * t) - p.radius - q.radius;
}

} // namespace shoal::physics
