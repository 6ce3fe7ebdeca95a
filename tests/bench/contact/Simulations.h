// Ways of finding and answering contacts between bones and fish: ours, and Bullet's with fish as capsules or
// ellipsoids. All take the same fish and the same movements of bones. World frame, metres and seconds.
#pragma once

#include "engine/physics/World.h"

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

namespace shoal::bench {

using glm::vec3;
using physics::Capsule;
using Bones = std::vector<Capsule>; // those of a hand, kHandBones, stand together
constexpr int kHandBones = 24;
constexpr float kFishRadius_m = 0.024f, kFishHalf_m = 0.030f; // a clownfish's capsule

struct Fish {
    vec3 place{0}, axis{0, 0, 1}, velocity{0}; // axis: unit length
};

struct Touch {
    int fish = 0, bone = 0;
    vec3 normal{0}; // unit, from the bone towards the fish
    float depth_m = 0;
    float time_s = 0; // time of first touch, from the tick's begin
    float seen_s = 0; // time at which normal and depth are right
};

class Simulation {
  public:
    virtual ~Simulation() = default;
    // Moves the bones evenly to other places, and the fish by one tick. Writes all touches; a pair may have
    // one in each substep.
    virtual void tick(const Bones& to, float dt_s, std::vector<Touch>& touches) = 0;
    virtual Fish fish(size_t index) const = 0;
};

// A row of the chart. Without substeps it is ours.
struct Method {
    const char* name;
    int substeps = 0;
    bool ellipsoids = false;
    bool continuous = false; // with Bullet's own continuous collision
    bool atOnce = false;     // ours, but a fish goes on with its new speed for the rest of the tick
    bool everyPair = false;  // ours without Bullet's tree of boxes, which finds the pairs that are near
    float scale = 100;       // Bullet's units a metre: its constants are for bodies of 0.05 to 10 units
};

class Ours final : public Simulation {
  public:
    Ours(const Method& method, const std::vector<Fish>& fish, const Bones& bones)
        : atOnce_(method.atOnce), everyPair_(method.everyPair), fish_(fish), parting_(fish.size(), vec3(0)),
          bones_(bones) {}

    Fish fish(size_t index) const override { return fish_[index]; }

    void tick(const Bones& to, float dt_s, std::vector<Touch>& touches) override {
        movers_.clear();
        for (size_t i = 0; i < to.size(); ++i) {
            const Capsule& from = bones_[i];
            const int bone = static_cast<int>(i);
            movers_.push_back({from, to[i], (to[i].a - from.a) / dt_s, (to[i].b - from.b) / dt_s,
                               bone / kHandBones, bone % kHandBones});
        }
        bodies_.clear();
        for (size_t i = 0; i < fish_.size(); ++i) {
            Fish& f = fish_[i];
            const Capsule before = capsuleOf(f);
            const vec3 velocity = f.velocity + parting_[i];
            f.place += velocity * dt_s;
            parting_[i] = vec3(0);
            bodies_.push_back({static_cast<uint32_t>(i), before, capsuleOf(f), velocity});
        }
        std::swap(contacts_, last_);
        if (everyPair_) {
            contacts_.clear();
            for (const physics::Body& body : bodies_)
                for (const physics::Mover& mover : movers_)
                    if (const auto found = physics::contactOf(mover, body, dt_s, last_))
                        contacts_.push_back(*found);
        } else {
            world_.touch(bodies_, movers_, dt_s, last_, contacts_);
        }
        touches.clear();
        for (size_t i = 0, end = 0; i < contacts_.size(); i = end) {
            const uint32_t body = contacts_[i].body;
            while (end < contacts_.size() && contacts_[end].body == body) ++end;
            const std::span<const physics::Contact> own(&contacts_[i], end - i);
            Fish& f = fish_[body];
            const vec3 velocity = physics::pushed(f.velocity, own);
            float begun = 1; // as a share of the tick; lasting contacts have 0
            for (const physics::Contact& c : own) begun = std::min(begun, c.time);
            if (atOnce_) f.place += (velocity - f.velocity) * (1 - begun) * dt_s;
            f.velocity = velocity;
            parting_[body] = physics::separating(own);
            for (const physics::Contact& c : own)
                touches.push_back({static_cast<int>(body), c.group * kHandBones + c.tag, c.normal, c.depth,
                                   c.time * dt_s, dt_s});
        }
        bones_ = to;
    }

  private:
    static Capsule capsuleOf(const Fish& f) {
        return {f.place - kFishHalf_m * f.axis, f.place + kFishHalf_m * f.axis, kFishRadius_m};
    }

    bool atOnce_, everyPair_;
    physics::World world_;
    std::vector<Fish> fish_;
    std::vector<vec3> parting_; // velocities of the next tick that are not kept
    Bones bones_;
    std::vector<physics::Mover> movers_;
    std::vector<physics::Body> bodies_;
    std::vector<physics::Contact> contacts_, last_;
};

inline btVector3 bt(vec3 v) { return {v.x, v.y, v.z}; }
inline vec3 fromBt(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Has the bounds of the fish's capsule, in which it lies. Without a margin Bullet takes it as it is.
class Ellipsoid final : public btConvexInternalShape {
  public:
    explicit Ellipsoid(float scale)
        : radii_(scale * btVector3(kFishRadius_m, kFishHalf_m + kFishRadius_m, kFishRadius_m)) {
        m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
        m_collisionMargin = 0;
    }
    btVector3 localGetSupportingVertexWithoutMargin(const btVector3& way) const override {
        const btVector3 wide = way * radii_;
        return wide.length() > SIMD_EPSILON ? radii_ * wide / wide.length() : btVector3(0, radii_.y(), 0);
    }
    void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* ways, btVector3* out,
                                                           int count) const override {
        for (int i = 0; i < count; ++i) out[i] = localGetSupportingVertexWithoutMargin(ways[i]);
    }
    void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
    const char* getName() const override { return "ellipsoid"; }

  private:
    btVector3 radii_;
};

class Bullet final : public Simulation {
  public:
    Bullet(const Method& method, const std::vector<Fish>& fish, const Bones& bones)
        : substeps_(method.substeps), scale_(method.scale), before_(bones), velocities_(fish.size()) {
        world_.setGravity({0, 0, 0});
        // Neither warm starting nor vector instructions, so that no processor has results of its own.
        world_.getSolverInfo().m_solverMode = 0;
        solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
        solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
        const auto add = [&](auto& bodies, float mass, float radius, const btTransform& place) {
            bodies.push_back(std::make_unique<btRigidBody>(
                btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, shapes_.back().get(), {1, 1, 1})));
            btRigidBody& body = *bodies.back();
            body.setCenterOfMassTransform(place);
            body.setFriction(0);
            body.setAngularFactor(0); // the game turns fish by rules of its own
            body.setUserIndex(static_cast<int>(bodies.size()) - 1);
            body.setActivationState(DISABLE_DEACTIVATION);
            if (method.continuous) {
                body.setCcdMotionThreshold(scale_ * radius);
                body.setCcdSweptSphereRadius(0.8f * scale_ * radius);
            }
            if (mass == 0) body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
            world_.addRigidBody(&body, mass == 0 ? 2 : 1, mass == 0 ? 1 : 2);
        };
        if (method.ellipsoids)
            shapes_.push_back(std::make_unique<Ellipsoid>(scale_));
        else
            shapes_.push_back(
                std::make_unique<btCapsuleShape>(scale_ * kFishRadius_m, scale_ * 2 * kFishHalf_m));
        for (const Fish& f : fish) {
            add(fish_, 0.1f, kFishRadius_m, transformOf(f.place, f.axis));
            fish_.back()->setLinearVelocity(bt(scale_ * f.velocity));
        }
        for (const Capsule& bone : bones) {
            shapes_.push_back(std::make_unique<btCapsuleShape>(scale_ * bone.radius,
                                                               scale_ * glm::distance(bone.a, bone.b)));
            add(bones_, 0, bone.radius, transformOf(bone));
        }
    }

    Fish fish(size_t index) const override {
        return {fromBt(fish_[index]->getCenterOfMassPosition()) / scale_, vec3(0),
                fromBt(fish_[index]->getLinearVelocity()) / scale_};
    }

    void tick(const Bones& to, float dt_s, std::vector<Touch>& touches) override {
        touches.clear();
        for (int step = 1; step <= substeps_; ++step) {
            const float part = static_cast<float>(step) / static_cast<float>(substeps_);
            for (size_t i = 0; i < to.size(); ++i)
                bones_[i]->setWorldTransform(transformOf(physics::between(before_[i], to[i], part)));
            for (size_t i = 0; i < fish_.size(); ++i) velocities_[i] = fish_[i]->getLinearVelocity();
            // One step of just this time, in which Bullet finds how fast its bones have moved.
            world_.stepSimulation(dt_s / static_cast<float>(substeps_), 0);
            readTouches(part * dt_s, touches);
        }
        before_ = to;
    }

  private:
    btTransform transformOf(vec3 place, vec3 axis) const {
        return btTransform(shortestArcQuat({0, 1, 0}, bt(axis)), bt(scale_ * place));
    }
    btTransform transformOf(const Capsule& c) const {
        return transformOf(0.5f * (c.a + c.b), glm::normalize(c.b - c.a));
    }

    // Adds of each pair the deepest point, if the two are as near as ours are when they touch, or if the fish
    // was pushed. (Bullet pushes early what it would meet in the next step.)
    void readTouches(float time_s, std::vector<Touch>& touches) {
        for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
            const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
            const btManifoldPoint* deepest = nullptr;
            for (int i = 0; i < manifold.getNumContacts(); ++i)
                if (!deepest || manifold.getContactPoint(i).getDistance() < deepest->getDistance())
                    deepest = &manifold.getContactPoint(i);
            if (!deepest) continue;
            const btCollisionObject *fish = manifold.getBody0(), *bone = manifold.getBody1();
            const bool swapped =
                fish->isKinematicObject(); // Bullet's normal goes from the second to the first
            if (swapped) std::swap(fish, bone);
            const int index = fish->getUserIndex();
            const float gap = deepest->getDistance() / scale_;
            if (gap > physics::kTouchGap_m && fish_[index]->getLinearVelocity() == velocities_[index])
                continue;
            touches.push_back({index, bone->getUserIndex(),
                               (swapped ? -1.0f : 1.0f) * fromBt(deepest->m_normalWorldOnB),
                               std::max(0.0f, -gap), time_s, time_s});
        }
    }

    int substeps_;
    float scale_;
    Bones before_;
    std::vector<btVector3> velocities_; // before the step
    // The world is declared last, because it looks at its bodies when it ends.
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> fish_, bones_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

inline std::unique_ptr<Simulation> makeSimulation(const Method& m, const std::vector<Fish>& fish,
                                                  const Bones& bones) {
    if (m.substeps == 0) return std::make_unique<Ours>(m, fish, bones);
    return std::make_unique<Bullet>(m, fish, bones);
}

} // namespace shoal::bench
