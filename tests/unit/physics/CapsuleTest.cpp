#include "engine/physics/Capsule.h"

#include "engine/core/Random.h"
#include "engine/physics/ContactModel.h"

#include <btBulletCollisionCommon.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::physics {
namespace {

// Single precision on lengths below 1 m, a handful of operations.
constexpr float kCapsuleTol = 1e-5f;

TEST(Separation, MatchesClosedForms) {
    const auto point = [](glm::vec3 p, float r) { return Capsule{p, p, r}; };
    EXPECT_NEAR(separation(point({0, 0, 0}, 0.1f), point({1, 0, 0}, 0.2f)), 0.7f, kCapsuleTol);
    // A point beside the middle of a segment, and beyond its end.
    const Capsule bar{{-1, 0, 0}, {1, 0, 0}, 0.1f};
    EXPECT_NEAR(separation(point({0.3f, 0.5f, 0}, 0.1f), bar), 0.3f, kCapsuleTol);
    EXPECT_NEAR(separation(point({4, 4, 0}, 0.1f), bar), 5 - 0.2f, kCapsuleTol);
    // Crossed bars, parallel bars, crossing bars.
    EXPECT_NEAR(separation(bar, {{0, 0.7f, -1}, {0, 0.7f, 1}, 0.1f}), 0.5f, kCapsuleTol);
    EXPECT_NEAR(separation(bar, {{-1, 0.4f, 0}, {1, 0.4f, 0}, 0.1f}), 0.2f, kCapsuleTol);
    EXPECT_NEAR(separation(bar, {{0, -1, 0}, {0, 1, 0}, 0.1f}), -0.2f, kCapsuleTol);
}

struct BulletCapsule {
    btCapsuleShape shape;
    btCollisionObject object;

    explicit BulletCapsule(const Capsule& c) : shape(c.radius, glm::distance(c.a, c.b)) {
        const glm::vec3 along = c.b - c.a, centre = 0.5f * (c.a + c.b);
        btTransform& place = object.getWorldTransform();
        place.setIdentity();
        place.setOrigin({centre.x, centre.y, centre.z});
        place.setRotation(shortestArcQuat({0, 1, 0}, btVector3(along.x, along.y, along.z).normalized()));
        object.setCollisionShape(&shape);
    }
};

struct LeastDistance : btCollisionWorld::ContactResultCallback {
    btScalar distance = 1;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        distance = std::min(distance, point.getDistance());
        return 0;
    }
};

glm::vec3 anywhere(Random& random, float maximum) {
    return {random.between(-maximum, maximum), random.between(-maximum, maximum),
            random.between(-maximum, maximum)};
}

// Bullet 3, which people trust, measures the same distances.
TEST(Separation, IsThatOfBullet) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    Random random(6, 1);
    int overlapping = 0;
    for (int round = 0; round < 2000; ++round) {
        const glm::vec3 a = anywhere(random, 0.3f), b = anywhere(random, 0.3f);
        const Capsule first{a, a + anywhere(random, 0.3f), 0.1f},
            second{b, b + anywhere(random, 0.3f), 0.06f};
        BulletCapsule one(first), other(second);
        LeastDistance least;
        least.m_closestDistanceThreshold = 1;
        world.contactPairTest(&one.object, &other.object, least);
        EXPECT_NEAR(least.distance, separation(first, second), 2e-5f) << round;
        overlapping += separation(first, second) < 0;
    }
    EXPECT_GT(overlapping, 200);
}

// firstTouch finds the touches that a thousand small steps along the same path find, at the same place.
TEST(FirstTouch, AgreesWithFineSteps) {
    Random random(5, 1);
    int hits = 0, grazed = 0;
    for (int round = 0; round < 3000; ++round) {
        const glm::vec3 along = anywhere(random, 0.03f), way = anywhere(random, 0.25f);
        const glm::vec3 middle = anywhere(random, 0.07f), turn = anywhere(random, 0.01f);
        const Capsule from{middle - way - along, middle - way + along, 0.008f};
        const Capsule to{middle + way - along - turn, middle + way + along + turn, 0.008f};
        const glm::vec3 reach = anywhere(random, 0.06f), drift = anywhere(random, 0.02f);
        const Capsule fishFrom{-reach, reach, 0.024f}, fishTo{drift - reach, drift + reach, 0.024f};
        if (separation(from, fishFrom) <= 0.001f) continue;
        constexpr int kSteps = 1000;
        float truth = 2, nearest = 1;
        for (int i = 0; i <= kSteps && truth > 1; ++i) {
            const float t = static_cast<float>(i) / kSteps;
            const float gap = separation(between(from, to, t), between(fishFrom, fishTo, t));
            nearest = std::min(nearest, gap);
            if (gap <= kTouchGap_m) truth = t;
        }
        const float found = firstTouch(from, to, fishFrom, fishTo);
        if (truth > 1) { // at most a graze that the steps stepped over
            if (found <= 1) {
                EXPECT_LT(nearest, 2 * kTouchGap_m);
                ++grazed;
            }
            continue;
        }
        ++hits;
        ASSERT_LE(found, 1) << "round " << round << ": passed through";
        const float gap = separation(between(from, to, found), between(fishFrom, fishTo, found));
        EXPECT_GT(gap, -2 * kCapsuleTol) << "round " << round << ": too late";
        EXPECT_LT(gap, 2 * kTouchGap_m) << "round " << round << ": too early";
    }
    EXPECT_GT(hits, 800);
    EXPECT_LT(grazed, 30);
}

// The bound along the nearest points' line ends at once where nothing comes nearer.
TEST(FirstTouch, NothingTouchesThatMovesApart) {
    const Capsule fish{{0, 0, -0.03f}, {0, 0, 0.03f}, 0.02f};
    const Capsule near{{0.04f, 0, 0}, {0.04f, 0, 0}, 0.01f}, far{{0.5f, 0, 0}, {0.5f, 0, 0}, 0.01f};
    EXPECT_GT(firstTouch(near, far, fish, fish), 1);
    EXPECT_GT(firstTouch(near, near, fish, fish), 1);
    EXPECT_LE(firstTouch(far, near, fish, {{0.02f, 0, -0.03f}, {0.02f, 0, 0.03f}, 0.02f}), 1);
}

} // namespace
} // namespace shoal::physics
