#include "engine/physics/World.h"

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <btBulletDynamicsCommon.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace shoal::physics {

namespace {

constexpr float kGravity_mps2 = 9.81f;
constexpr float kSpinLoss_Hz = 0.6f; // rate at which water stops a slow spin...
constexpr float kSpinLoss = 0.15f;   // ...and the part that grows with the spin, per radian
constexpr float kStepShare = 0.5f;   // a loose body moves by at most this share of its radius in a step...
constexpr int kMaxSteps = 8;         // ...and the tick is cut into at most this many steps
constexpr float kMaxLoose_mps = 15;  // greatest speed of a loose body
constexpr float kMaxSpin_radps = 20;
constexpr float kGap_m = 0.001f;    // surfaces this near count as a contact that may close
constexpr float kFar_m = 100;       // nothing is farther away
constexpr float kKnock_mps = 0.15f; // slower meetings are no knocks

enum Group { kBones = 1, kBodies = 2, kLoose = 4, kGround = 8 };

btVector3 bt(glm::vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
// Returns whether a place or a velocity may enter the world: not if it is NaN or beyond kFar_m.
bool mayEnter(glm::vec3 v) { return glm::dot(v, v) < kFar_m * kFar_m; }
bool mayEnter(const Capsule& c) {
    return mayEnter(c.a) && mayEnter(c.b) && c.radius > 0 && c.radius < kFar_m;
}
bool mayEnter(const Body& b) { return mayEnter(b.before) && mayEnter(b.after) && mayEnter(b.velocity); }
bool mayEnter(const Mover& m) {
    return mayEnter(m.before) && mayEnter(m.after) && mayEnter(0.1f * m.velocityA) &&
           mayEnter(0.1f * m.velocityB);
}
float volume_m3(const LooseBody& b) {
    return std::numbers::pi_v<float> * b.radius * b.radius * (2 * b.half + 4.0f / 3 * b.radius);
}
// Returns its mass and that of the water that it has to move along, as if it were a sphere: Batchelor 1967,
// "An Introduction to Fluid Dynamics", 6.4. A cylinder across its path moves twice as much water.
float inertia_kg(const LooseBody& b) { return (b.density_kgpm3 + 0.5f * kWater_kgpm3) * volume_m3(b); }

// A box around capsules: a body outside it touches none of them.
struct Box {
    glm::vec3 low{kFar_m}, high{-kFar_m};

    void add(const Capsule& c, float more_m = 0) {
        low = glm::min(low, glm::min(c.a, c.b) - (c.radius + more_m));
        high = glm::max(high, glm::max(c.a, c.b) + (c.radius + more_m));
    }
    bool meets(const Box& other) const {
        return glm::all(glm::lessThanEqual(low, other.high)) && glm::all(glm::lessThanEqual(other.low, high));
    }
};
Box boxOf(const Body& body) {
    Box box;
    box.add(body.before, kLift_m);
    box.add(body.after, kLift_m);
    return box;
}

// A capsule around its own origin. For Bullet it is a segment with its radius as the margin.
class CapsuleShape final : public btConvexInternalShape {
  public:
    CapsuleShape() { m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE; }

    // swept: how far its middle has come; the box holds all of the way.
    void set(glm::vec3 half, float radius, glm::vec3 swept, float more_m) {
        half_ = bt(half);
        swept_ = bt(swept);
        more_ = more_m;
        setMargin(radius);
    }
    Capsule in(const btTransform& t) const {
        const btVector3 half = t.getBasis() * half_;
        return {vec(t.getOrigin() - half), vec(t.getOrigin() + half), m_collisionMargin};
    }

    btVector3 localGetSupportingVertexWithoutMargin(const btVector3& way) const override {
        return way.dot(half_) < 0 ? -half_ : half_;
    }
    void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* ways, btVector3* out,
                                                           int count) const override {
        for (int i = 0; i < count; ++i) out[i] = localGetSupportingVertexWithoutMargin(ways[i]);
    }
    void getAabb(const btTransform& t, btVector3& low, btVector3& high) const override {
        const float around = m_collisionMargin + more_;
        const btVector3 reach = (t.getBasis() * half_).absolute() + btVector3(around, around, around);
        const btVector3 before = t.getOrigin() - swept_;
        low = high = t.getOrigin();
        low.setMin(before);
        high.setMax(before);
        low -= reach;
        high += reach;
    }
    void calculateLocalInertia(btScalar, btVector3& out) const override { out.setZero(); }
    const char* getName() const override { return "capsule"; }

  private:
    btVector3 half_{0, 0, 0}, swept_{0, 0, 0};
    float more_ = 0; // the ends' ways differ from the middle's by at most this
};

// The ground, whose triangles come from the caller; nothing is stored.
class GroundShape final : public btConcaveShape {
  public:
    // Bullet takes CUSTOM_CONCAVE_SHAPE_TYPE for a distance field, and asks it for no triangles.
    GroundShape() { m_shapeType = TERRAIN_SHAPE_PROXYTYPE; }
    const Ground* ground = nullptr;

    void processAllTriangles(btTriangleCallback* callback, const btVector3& low,
                             const btVector3& high) const override {
        int index = 0;
        ground->triangles(vec(low), vec(high), [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
            btVector3 triangle[3] = {bt(a), bt(b), bt(c)};
            callback->processTriangle(triangle, 0, index++);
        });
    }
    void getAabb(const btTransform&, btVector3& low, btVector3& high) const override {
        low.setValue(-kFar_m, -kFar_m, -kFar_m);
        high.setValue(kFar_m, kFar_m, kFar_m);
    }
    void setLocalScaling(const btVector3&) override {}
    const btVector3& getLocalScaling() const override {
        static const btVector3 one(1, 1, 1);
        return one;
    }
    void calculateLocalInertia(btScalar, btVector3& out) const override { out.setZero(); }
    const char* getName() const override { return "ground"; }
};

// A capsule in the world, and the mover or body that it is copied from in this call.
struct Object {
    explicit Object(uint32_t own) : id(own), body(0, nullptr, &shape) {
        body.setUserPointer(this);
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setFlags(0); // no gyroscopic forces
    }
    void place(const Capsule& from, const Capsule& to) {
        active = true;
        const glm::vec3 at = middle(to), swept = at - middle(from), half = 0.5f * (to.b - to.a);
        shape.set(half, to.radius, swept, glm::distance(half, 0.5f * (from.b - from.a)));
        body.setWorldTransform(btTransform(btMatrix3x3::getIdentity(), bt(at)));
    }

    uint32_t id;
    bool active = false;
    CapsuleShape shape;
    btRigidBody body;
    const Mover* mover = nullptr;
    const Body* given = nullptr;
};

Object* objectOf(const btCollisionObject* object) { return static_cast<Object*>(object->getUserPointer()); }
uint32_t idOf(const btCollisionObject* object) {
    return object->getUserPointer() ? objectOf(object)->id : kGroundId;
}

// The contacts that touch() looks for; null while loose bodies move.
struct Touching {
    std::span<const Contact> last;
    float dt_s;
    std::vector<Contact>& out;
};

// A bone meets bodies only while touch() runs, and everything else only while move() runs.
class Dispatcher final : public btCollisionDispatcher {
  public:
    using btCollisionDispatcher::btCollisionDispatcher;
    Touching* touching = nullptr;

    bool needsCollision(const btCollisionObject* one, const btCollisionObject* other) override {
        const Object *a = objectOf(one), *b = objectOf(other);
        if ((a && !a->active) || (b && !b->active)) return false;
        return ((a && a->mover) || (b && b->mover)) == (touching != nullptr);
    }
    btPersistentManifold* getNewManifold(const btCollisionObject* one,
                                         const btCollisionObject* other) override {
        btPersistentManifold* manifold = btCollisionDispatcher::getNewManifold(one, other);
        // Bullet's own gap depends on the size that the bodies had when they first met.
        manifold->setContactBreakingThreshold(kGap_m);
        return manifold;
    }
};

// Two capsules, in closed form. Bones keep contacts of their own (Contact.h), for the rules to read; the
// others meet at one point, which Bullet's solver reads.
class CapsulePair final : public btActivatingCollisionAlgorithm {
  public:
    CapsulePair(const btCollisionAlgorithmConstructionInfo& info, Dispatcher& dispatcher)
        : btActivatingCollisionAlgorithm(info), own_(dispatcher) {}
    ~CapsulePair() override {
        if (manifold_) own_.releaseManifold(manifold_);
    }
    void processCollision(const btCollisionObjectWrapper* one, const btCollisionObjectWrapper* other,
                          const btDispatcherInfo&, btManifoldResult*) override {
        // Bullet's order is that in which the objects were made; ours is that of their ids.
        if (idOf(one->getCollisionObject()) > idOf(other->getCollisionObject())) std::swap(one, other);
        const Object *a = objectOf(one->getCollisionObject()), *b = objectOf(other->getCollisionObject());
        if (own_.touching) {
            if (!a->mover) std::swap(a, b);
            Touching& to = *own_.touching;
            if (const auto found = contactOf(*a->mover, *b->given, to.dt_s, to.last))
                to.out.push_back(*found);
            return;
        }
        const Capsule first = a->shape.in(a->body.getWorldTransform()),
                      second = b->shape.in(b->body.getWorldTransform());
        const Nearest at = nearest(first, second);
        const glm::vec3 apart = at.onFirst - at.onSecond;
        const float distance = glm::length(apart), gap = distance - first.radius - second.radius;
        if (gap > 0) return;
        if (!manifold_) manifold_ = own_.getNewManifold(&a->body, &b->body);
        const glm::vec3 normal = distance > kCrossed_m ? apart / distance : glm::vec3(0, 1, 0);
        btManifoldResult out(one, other);
        out.setPersistentManifold(manifold_);
        out.addContactPoint(bt(normal), bt(at.onSecond + normal * second.radius), gap);
    }
    btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                   btManifoldResult*) override {
        return 1;
    }
    void getAllContactManifolds(btManifoldArray& all) override {
        if (manifold_) all.push_back(manifold_);
    }

    struct Maker final : btCollisionAlgorithmCreateFunc {
        explicit Maker(Dispatcher& own) : dispatcher(own) {}
        btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                       const btCollisionObjectWrapper*,
                                                       const btCollisionObjectWrapper*) override {
            return new (dispatcher.allocateCollisionAlgorithm(sizeof(CapsulePair)))
                CapsulePair(info, dispatcher);
        }
        Dispatcher& dispatcher;
    };

  private:
    Dispatcher& own_;
    btPersistentManifold* manifold_ = nullptr;
};

btDefaultCollisionConstructionInfo poolSizes() {
    btDefaultCollisionConstructionInfo sizes;
    sizes.m_defaultMaxPersistentManifoldPoolSize = 256;
    sizes.m_defaultMaxCollisionAlgorithmPoolSize = 4096;
    return sizes;
}

glm::vec3 limited(glm::vec3 v, float most) {
    const float length = glm::length(v);
    return length > most ? v * (most / length) : v;
}

// Returns the speed with which the manifold's bodies close at its point, before they are solved.
float closing(const btPersistentManifold& m, const btManifoldPoint& point) {
    const auto speed = [&](const btCollisionObject* object, const btVector3& at) {
        const btRigidBody* body = btRigidBody::upcast(object);
        return body->getVelocityInLocalPoint(at - body->getWorldTransform().getOrigin());
    };
    return (speed(m.getBody1(), point.getPositionWorldOnB()) -
            speed(m.getBody0(), point.getPositionWorldOnA()))
        .dot(point.m_normalWorldOnB);
}

} // namespace

glm::vec3 inWater(const LooseBody& b, float dt_s) {
    // Quadratic drag on the mean projected area, which is a quarter of a convex body's surface (Cauchy). It
    // is implicit in the velocity, so that it never reverses the motion.
    const float area = std::numbers::pi_v<float> * b.radius * (b.radius + b.half);
    const float mass = inertia_kg(b);
    const float buoyancy_mps2 = (kWater_kgpm3 - b.density_kgpm3) * volume_m3(b) * kGravity_mps2 / mass;
    const float drag_Hz = 0.5f * kWater_kgpm3 * b.drag * area * glm::length(b.velocity) / mass;
    return (b.velocity + glm::vec3(0, buoyancy_mps2 * dt_s, 0)) / (1 + drag_Hz * dt_s);
}

struct World::Impl {
    btDefaultCollisionConfiguration configuration{poolSizes()};
    Dispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    CapsulePair::Maker maker{dispatcher};
    GroundShape groundShape;
    btRigidBody ground{0, nullptr, &groundShape};
    std::vector<std::unique_ptr<Object>> bones, bodies, loose; // bodies, loose: by id
    std::vector<btCollisionObject*> moving;                    // scratch
    std::vector<btPersistentManifold*> manifolds;              // scratch

    Impl() {
        dispatcher.registerCollisionCreateFunc(CUSTOM_CONVEX_SHAPE_TYPE, CUSTOM_CONVEX_SHAPE_TYPE, &maker);
        ground.setRestitution(1);
        world.addRigidBody(&ground, kGround, kLoose);
        world.setGravity({0, 0, 0});
        world.getDispatchInfo().m_useContinuous = false; // bounding boxes hold present positions only
        btContactSolverInfo& info = world.getSolverInfo();
        info.m_solverMode = 0; // scalar rows, no warm starting, no random order
        info.m_splitImpulsePenetrationThreshold = 0;
        info.m_splitImpulseTurnErp = 0; // turning by it would call the C library's sine
    }
    ~Impl() {
        for (auto* all : {&bones, &bodies, &loose})
            for (auto& object : *all)
                if (object) world.removeRigidBody(&object->body);
        world.removeRigidBody(&ground);
    }

    // Returns the object at that place of the list; makes it if there is none.
    Object& at(std::vector<std::unique_ptr<Object>>& list, size_t place, Group group) {
        if (place >= list.size()) list.resize(place + 1);
        if (!list[place]) {
            list[place] = std::make_unique<Object>(static_cast<uint32_t>(place));
            btRigidBody& body = list[place]->body;
            if (group != kLoose)
                body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
            else
                body.setFriction(1);
            world.addRigidBody(&body, group,
                               group == kBones    ? kBodies
                               : group == kBodies ? kBones | kLoose
                                                  : kBodies | kLoose | kGround);
        }
        return *list[place];
    }

    void clear() {
        for (auto* all : {&bones, &bodies, &loose})
            for (auto& object : *all)
                if (object) object->active = false;
    }

    void placeBody(const Body& body, const Capsule& from, const Capsule& to) {
        Object& object = at(bodies, body.id, kBodies);
        object.place(from, to);
        object.given = &body;
        object.body.setLinearVelocity(bt(body.velocity));
        world.updateSingleAabb(&object.body);
    }

    void findPairs() {
        for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
            dispatcher.getManifoldByIndexInternal(i)->clearManifold();
        // The tree adds pairs as boxes move. Bullet's own clean-up of its tree allocates, so it is not
        // called; pairs whose boxes no longer overlap are removed here.
        btOverlappingPairCache& pairs = *broadphase.getOverlappingPairCache();
        for (int i = pairs.getNumOverlappingPairs() - 1; i >= 0; --i) {
            const btBroadphasePair& pair = pairs.getOverlappingPairArray()[i];
            const auto volume = [](btBroadphaseProxy* proxy) -> const btDbvtVolume& {
                return static_cast<btDbvtProxy*>(proxy)->leaf->volume;
            };
            if (!Intersect(volume(pair.m_pProxy0), volume(pair.m_pProxy1)))
                pairs.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, &dispatcher);
        }
        dispatcher.dispatchAllCollisionPairs(broadphase.getOverlappingPairCache(), world.getDispatchInfo(),
                                             &dispatcher);
    }

    void placeLoose(const LooseBody& b) {
        Object& object = at(loose, b.id, kLoose);
        object.active = true;
        object.shape.set({0, 0, b.half}, b.radius, glm::vec3(0), 0);
        btRigidBody& body = object.body;
        const float mass = inertia_kg(b), across = b.radius * b.radius, along = 2 * (b.half + b.radius);
        const float turning = mass * (3 * across + along * along) / 12; // of a cylinder
        body.setMassProps(mass, {turning, turning, 0.5f * mass * across});
        body.setWorldTransform(btTransform(
            btQuaternion(b.worldFromBody.x, b.worldFromBody.y, b.worldFromBody.z, b.worldFromBody.w),
            bt(b.position)));
        body.updateInertiaTensor();
        body.setRestitution(b.bounce);
        body.setLinearVelocity(bt(b.velocity));
        body.setAngularVelocity(bt(b.spin));
        world.updateSingleAabb(&body);
        moving.push_back(&body);
    }

    // Solves the manifolds found, in an order that depends on ids alone.
    void solve(float dt_s, std::vector<Knock>& out) {
        manifolds.clear();
        for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
            if (btPersistentManifold* m = dispatcher.getManifoldByIndexInternal(i); m->getNumContacts() > 0)
                manifolds.push_back(m);
        const auto ids = [](const btPersistentManifold* m) {
            const uint32_t a = idOf(m->getBody0()), b = idOf(m->getBody1());
            return std::pair(std::min(a, b), std::max(a, b));
        };
        std::ranges::sort(manifolds, {}, ids);
        for (const btPersistentManifold* m : manifolds) {
            const auto [low, high] = ids(m);
            const bool lowIsLoose = low < loose.size() && loose[low] && loose[low]->active;
            Knock knock{lowIsLoose ? low : high, lowIsLoose ? high : low, {}, kKnock_mps};
            for (int i = 0; i < m->getNumContacts(); ++i)
                if (const float speed = closing(*m, m->getContactPoint(i)); speed > knock.closing_mps) {
                    knock.closing_mps = speed;
                    knock.point = vec(m->getContactPoint(i).getPositionWorldOnB());
                }
            if (knock.closing_mps > kKnock_mps) out.push_back(knock);
        }
        btContactSolverInfo& info = world.getSolverInfo();
        info.m_timeStep = dt_s;
        solver.solveGroup(moving.data(), static_cast<int>(moving.size()), manifolds.data(),
                          static_cast<int>(manifolds.size()), nullptr, 0, info, nullptr, &dispatcher);
    }

    void takeBack(LooseBody& b, float dt_s) {
        const btRigidBody& body = loose[b.id]->body;
        const glm::vec3 velocity = limited(vec(body.getLinearVelocity()), kMaxLoose_mps);
        const glm::vec3 spin = limited(vec(body.getAngularVelocity()), kMaxSpin_radps);
        if (!mayEnter(velocity) || !mayEnter(spin) || !mayEnter(vec(body.getWorldTransform().getOrigin())))
            return; // a degenerate contact: it stays for this step
        b.velocity = velocity;
        b.position = vec(body.getWorldTransform().getOrigin()) + velocity * dt_s;
        b.spin = spin / (1 + (kSpinLoss_Hz + kSpinLoss * glm::length(spin)) * dt_s);
        b.worldFromBody =
            glm::normalize(b.worldFromBody + glm::quat(0, 0.5f * dt_s * b.spin) * b.worldFromBody);
    }
};

World::World() : impl_(makeHidden<Impl>()) {}

void World::touch(std::span<const Body> bodies, std::span<const Mover> movers, float dt_s,
                  std::span<const Contact> last, std::vector<Contact>& out) {
    Impl& w = *impl_;
    out.clear();
    w.clear();
    std::array<Box, 2> reach; // of each hand
    std::array<bool, 2> isNear{};
    const auto handOf = [](const Mover& mover) { return static_cast<size_t>(mover.group) % 2; };
    for (const Mover& mover : movers)
        for (const Capsule& capsule : {mover.before, mover.after})
            if (mayEnter(mover)) reach[handOf(mover)].add(capsule);
    for (const Body& body : bodies) {
        w.at(w.bodies, body.id, kBodies); // takes its memory now, wherever the body is
        if (!mayEnter(body)) continue;
        const Box box = boxOf(body);
        const std::array<bool, 2> meets = {box.meets(reach[0]), box.meets(reach[1])};
        for (size_t h = 0; h < 2; ++h) isNear[h] = isNear[h] || meets[h];
        if (meets[0] || meets[1]) w.placeBody(body, body.before, body.after);
    }
    for (size_t i = 0; i < movers.size(); ++i) {
        Object& object = w.at(w.bones, i, kBones);
        if (!isNear[handOf(movers[i])] || !mayEnter(movers[i])) continue;
        object.place(movers[i].before, movers[i].after);
        object.mover = &movers[i];
        w.world.updateSingleAabb(&object.body);
    }
    if (!isNear[0] && !isNear[1]) return;
    Touching touching{last, dt_s, out};
    w.dispatcher.touching = &touching;
    w.findPairs();
    w.dispatcher.touching = nullptr;
    // A total order, so the result does not depend on the order of pairs.
    std::ranges::sort(out, {}, [](const Contact& c) { return std::tuple(c.body, c.group, c.tag); });
}

void World::move(std::span<LooseBody> loose, std::span<const Body> bodies, const Ground& ground, float dt_s,
                 std::vector<Knock>& out) {
    Impl& w = *impl_;
    out.clear();
    if (loose.empty()) return;
    w.clear();
    w.groundShape.ground = &ground;
    w.ground.setFriction(ground.friction);
    float steps = 1;
    for (const LooseBody& b : loose)
        steps = std::max(steps, glm::length(b.velocity) * dt_s / (kStepShare * b.radius));
    const int count = std::min(static_cast<int>(std::ceil(steps)), kMaxSteps);
    const float step_s = dt_s / static_cast<float>(count);
    for (int i = 0; i < count; ++i) {
        const float share = static_cast<float>(i + 1) / static_cast<float>(count);
        for (const Body& body : bodies) {
            if (!mayEnter(body)) continue;
            const Box box = boxOf(body);
            const auto isNear = [&](const LooseBody& b) {
                Box around;
                around.add({b.position, b.position, b.radius + b.half}, kMaxLoose_mps * dt_s);
                return box.meets(around);
            };
            if (std::ranges::none_of(loose, isNear)) continue;
            const Capsule now = between(body.before, body.after, share);
            w.placeBody(body, now, now);
        }
        w.moving.clear();
        for (LooseBody& b : loose) {
            b.velocity = inWater(b, step_s);
            w.placeLoose(b);
        }
        w.findPairs();
        w.solve(step_s, out);
        for (LooseBody& b : loose) w.takeBack(b, step_s);
    }
    // The hardest knock of each pair comes first and stays.
    std::ranges::sort(out, {}, [](const Knock& k) { return std::tuple(k.loose, k.other, -k.closing_mps); });
    const auto same = [](const Knock& a, const Knock& b) { return a.loose == b.loose && a.other == b.other; };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

} // namespace shoal::physics
