#include "engine/physics/Contact.h"
#include "engine/core/Random.h"
#include "engine/physics/Capsule.h"
#include "engine/physics/ContactModel.h"
#include "engine/physics/World.h"
#include "tests/Test.h"

#include <btBulletCollisionCommon.h>

namespace shoal::physics {
namespace {

constexpr float kDt = 1.0f / 120;

// Single precision on lengths below 1 m, a handful of operations.
constexpr float kTol = 1e-5f;

Mover still(Capsule c, int tag = 0) { return {c, c, glm::vec3(0), glm::vec3(0), 0, tag}; }

// Contacts of one tick in a world of its own.
std::vector<Contact> collide(std::span<const Body> bodies, std::span<const Mover> movers,
                             std::span<const Contact> last = {}) {
    std::vector<Contact> out;
    World().touch(bodies, movers, kDt, last, out);
    return out;
}
std::vector<Contact> collide(const Body& body, const Mover& mover, std::span<const Contact> last = {}) {
    return collide({&body, 1}, {&mover, 1}, last);
}

// A sphere that pushes as fast as it goes.
Mover sphere(glm::vec3 from, glm::vec3 to, float radius) {
    const glm::vec3 velocity = (to - from) / kDt;
    return {{from, from, radius}, {to, to, radius}, velocity, velocity};
}

// A body along z that has been moving at that velocity.
Body fishAt(glm::vec3 at, float radius, float half, glm::vec3 velocity = glm::vec3(0), uint32_t id = 0) {
    const glm::vec3 reach(0, 0, half), way = velocity * kDt;
    return {id, {at - reach - way, at + reach - way, radius}, {at - reach, at + reach, radius}, velocity};
}

TEST(Contact, TellsDepthNormalAndPointOfSphereAgainstCapsule) {
    const Body fish = fishAt({0, 0, 0}, 0.03f, 0.05f, {0, 0, 0}, 5);
    // A sphere of 1 cm, 3.5 cm left of the axis: 5 mm deep.
    const auto contacts = collide(fish, still({{-0.035f, 0, 0.02f}, {-0.035f, 0, 0.02f}, 0.01f}, 7));
    ASSERT_EQ(contacts.size(), 1u);
    const Contact& c = contacts[0];
    EXPECT_EQ(c.body, 5u);
    EXPECT_EQ(c.tag, 7);
    EXPECT_NEAR(c.depth, 0.005f, kTol);
    EXPECT_NEAR(glm::distance(c.normal, glm::vec3(1, 0, 0)), 0, kTol);
    EXPECT_NEAR(glm::distance(c.point, glm::vec3(-0.03f, 0, 0.02f)), 0, kTol);
    EXPECT_EQ(c.closingSpeed, 0);
}

TEST(Contact, ClosingSpeedIsRelative) {
    const Body fish = fishAt({0, 0, 0}, 0.03f, 0.05f, {-0.5f, 0, 0});
    const Mover tip = sphere({-0.06f, 0, 0}, {-0.03f, 0, 0}, 0.01f); // 3.6 m/s towards it
    const auto contacts = collide(fish, tip);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].closingSpeed, 4.1f, 1e-3f);
    // The gap is 60 mm, and 4.17 mm that the body comes, less 40 mm of radii: 24.17 mm, of which 34.17 mm
    // close in a tick. It counts as closed at kTouchGap_m.
    EXPECT_NEAR(contacts[0].time, 24.17f / 34.17f, kTouchGap_m / 0.034f);
    EXPECT_TRUE(contacts[0].fresh);
}

TEST(Contact, NothingTunnelsAtAnySpeedBelowATeleport) {
    const Body fish = fishAt({0, 0, 0}, 0.02f, 0.03f);
    for (float speed : {1.0f, 5.0f, 20.0f, 60.0f, 150.0f})
        for (float offset : {0.1f, 0.35f, 0.5f, 0.77f, 0.9f}) // where in the tick it passes
            for (float aside : {0.0f, 0.012f}) {
                const float way = speed * kDt;
                const Mover tip = sphere({-way * offset, aside, 0}, {way * (1 - offset), aside, 0}, 0.006f);
                EXPECT_EQ(collide(fish, tip).size(), 1u)
                    << speed << " m/s, offset " << offset << ", aside " << aside;
            }
}

TEST(Contact, ATeleportTouchesNothingOnItsWay) {
    EXPECT_TRUE(collide(fishAt({0, 0, 0}, 0.02f, 0.03f), sphere({-1, 0, 0}, {1, 0, 0}, 0.006f)).empty());
}

TEST(Contact, ResultIsSortedAndIndependentOfOrderAndHistory) {
    std::vector<Body> bodies;
    std::vector<Mover> movers;
    for (uint32_t i = 0; i < 6; ++i)
        bodies.push_back(fishAt({0.03f * static_cast<float>(i), 0, 0}, 0.03f, 0.04f, {0, 0, 0}, i));
    for (int i = 0; i < 6; ++i) {
        Mover m = sphere({-0.1f, 0.01f * static_cast<float>(i), 0}, {0.15f, 0.01f, 0}, 0.008f);
        m.group = i % 2;
        m.tag = i;
        movers.push_back(m);
    }
    const auto key = [](const Contact& c) { return std::tuple(c.body, c.group, c.tag); };
    const auto same = [&](const Contact& a, const Contact& b) {
        return key(a) == key(b) && a.point == b.point && a.normal == b.normal && a.depth == b.depth;
    };
    const auto forwards = collide(bodies, movers);
    ASSERT_GT(forwards.size(), 10u);
    for (size_t i = 1; i < forwards.size(); ++i) EXPECT_LT(key(forwards[i - 1]), key(forwards[i]));
    std::reverse(bodies.begin(), bodies.end());
    std::reverse(movers.begin(), movers.end());
    std::vector<Contact> backwards;
    for (int round = 0; round < 3; ++round) World().touch(bodies, movers, kDt, {}, backwards);
    ASSERT_EQ(forwards.size(), backwards.size());
    for (size_t i = 0; i < forwards.size(); ++i) EXPECT_TRUE(same(forwards[i], backwards[i])) << i;
}

// A finger that presses on past the axis keeps pushing the way it came from.
TEST(Contact, ALastingContactNeverFlipsHoweverDeepItGoes) {
    const Body fish = fishAt({0, 0, 0}, 0.03f, 0.05f);
    std::vector<Contact> last;
    float depth = 0;
    for (int i = 0; i < 60; ++i) {
        const auto x = [](int step) { return -0.045f + 0.001f * static_cast<float>(step); };
        const Mover tip = sphere({x(i), 0.002f, 0.01f}, {x(i + 1), 0.002f, 0.01f}, 0.008f);
        auto now = collide(fish, tip, last);
        if (!now.empty()) {
            EXPECT_GT(now[0].normal.x, 0.7f) << "step " << i;
            EXPECT_GE(now[0].depth, depth);
            // No jump: as deep as it went, and what the tilt of the normal makes of it.
            EXPECT_LT(now[0].depth - depth, 0.003f) << "step " << i;
            depth = now[0].depth;
            const glm::vec3 was = last.empty() ? now[0].normal : last[0].normal;
            EXPECT_GT(glm::dot(now[0].normal, was), 0.97f);
        } else
            EXPECT_LT(i, 7) << "contact lost";
        last = std::move(now);
    }
    EXPECT_NEAR(depth, 0.038f + 0.015f, 0.002f); // both radii, and 15 mm past the axis
}

TEST(Contact, ABoneThatHasGoneRightThroughIsFree) {
    const Body fish = fishAt({0, 0, 0}, 0.03f, 0.05f);
    std::vector<Contact> last;
    int touching = 0;
    for (int i = 0; i < 40; ++i) {
        const float a = -0.1f + 0.005f * static_cast<float>(i);
        const Mover tip = sphere({a, 0.002f, 0}, {a + 0.005f, 0.002f, 0}, 0.008f);
        last = collide(fish, tip, last);
        touching += !last.empty();
    }
    EXPECT_TRUE(last.empty());
    EXPECT_GT(touching, 10);
}

// A bone that appears inside a fish has no earlier position. The way out leads out, and no shorter way does:
// also of axes along one line and of spheres in one place.
TEST(Contact, TheWayOutOfCrossedAxesIsTheShortest) {
    const Body fish = fishAt({0, 0, 0}, 0.03f, 0.05f);
    const glm::vec3 along = fish.after.b - fish.after.a;
    Random random(9, 1);
    for (int round = 0; round < 100; ++round) {
        glm::vec3 reach(random.between(-0.05f, 0.05f), random.between(-0.05f, 0.05f),
                        random.between(-0.05f, 0.05f));
        if (round % 10 == 0) reach = along * random.between(-0.6f, 0.6f);
        if (round % 10 == 1) reach = glm::vec3(0);
        const Mover bone = still({-reach, reach, 0.008f});
        const auto contacts = collide(fish, bone);
        ASSERT_EQ(contacts.size(), 1u);
        ASSERT_NEAR(glm::length(contacts[0].normal), 1, kTol) << round;
        EXPECT_EQ(contacts[0].closingSpeed, 0);
        const auto movedBy = [&](glm::vec3 way) {
            return separation(bone.after, {fish.after.a + way, fish.after.b + way, fish.after.radius});
        };
        EXPECT_NEAR(movedBy(contacts[0].normal * contacts[0].depth), 0, 1e-4f) << round;
        for (int other = 0; other < 100; ++other) {
            const glm::vec3 way(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            EXPECT_LT(movedBy(glm::normalize(way) * (contacts[0].depth - 1e-4f)), 0) << round;
        }
    }
}

Contact against(glm::vec3 normal, glm::vec3 moverVelocity = glm::vec3(0), float depth = 0) {
    return {
        .lasting = true, .normal = glm::normalize(normal), .depth = depth, .moverVelocity = moverVelocity};
}

TEST(Push, ABoneTakesAlongWhatItMeetsAndDoesNotBounceIt) {
    const Contact c = against({1, 0, 0}, {2, 5, 0});
    const glm::vec3 v = pushed({-1, 0.3f, 0}, {&c, 1});
    EXPECT_NEAR(v.x, 2, 3 * kSoftness); // all but the softness of it: a change of 3 m/s
    EXPECT_LE(v.x, 2);
    EXPECT_EQ(v.y, 0.3f) << "no friction on what swims free";
    // A body that leaves already is not pushed.
    EXPECT_EQ(pushed({3, 0, 0}, {&c, 1}), glm::vec3(3, 0, 0));
}

TEST(Push, AgainstBonesAtRestNothingGainsSpeed) {
    Random random(3, 1);
    for (int round = 0; round < 5000; ++round) {
        std::vector<Contact> contacts;
        const int count = 1 + static_cast<int>(random.below(48));
        for (int i = 0; i < count; ++i)
            contacts.push_back(
                against({random.between(-1, 1), random.between(-1, 1), random.between(0.1f, 1)}, glm::vec3(0),
                        random.between(0, 0.05f)));
        if (round % 2)
            for (size_t i = 0; i < contacts.size(); i += 2) contacts[i].normal = -contacts[i].normal;
        const glm::vec3 v(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
        // The solver descends on |v|^2 + softness: only rounding of some hundred additions may be added.
        EXPECT_LE(glm::length(pushed(v, contacts)), glm::length(v) * (1 + 1e-5f)) << round;
    }
}

TEST(Push, BetweenTwoHandsThatCloseItComesToRest) {
    const Contact both[] = {against({1, 0, 0}, {1, 0, 0}, 0.01f), against({-1, 0, 0}, {-1, 0, 0}, 0.01f)};
    EXPECT_LT(glm::length(pushed({0.4f, 0, 0}, both)), 0.5f) << "neither wins";
    EXPECT_LT(glm::length(separating(both)), 0.1f) << "and it is not spat out";
}

// An overlap of 5 cm resolves, however fast the bone goes: no tick moves the body faster than kPartMax_mps or
// than the one before, and none moves it back.
TEST(Separating, ResolvesAnOverlapWithoutPopping) {
    const auto speed_mps = [](float depth) {
        const Contact c = against({0, 0, 1}, {0, 0, 20}, depth);
        return separating({&c, 1}).z;
    };
    float depth = 0.05f, before = kPartMax_mps;
    int ticks = 0;
    for (; depth > kPartSlop_m + 1e-4f && ticks < 600; ++ticks) {
        const float speed = speed_mps(depth);
        EXPECT_GE(speed, 0);
        EXPECT_LE(speed, before);
        before = speed;
        depth -= speed / 120;
    }
    EXPECT_LT(ticks, 120) << "within a second";
    EXPECT_GT(depth, 0);
    EXPECT_EQ(speed_mps(0.0005f), 0) << "what hardly overlaps is let be";
}

TEST(Separation, MatchesClosedForms) {
    const auto point = [](glm::vec3 p, float r) { return Capsule{p, p, r}; };
    EXPECT_NEAR(separation(point({0, 0, 0}, 0.1f), point({1, 0, 0}, 0.2f)), 0.7f, kTol);
    // A point beside the middle of a segment, and beyond its end.
    const Capsule bar{{-1, 0, 0}, {1, 0, 0}, 0.1f};
    EXPECT_NEAR(separation(point({0.3f, 0.5f, 0}, 0.1f), bar), 0.3f, kTol);
    EXPECT_NEAR(separation(point({4, 4, 0}, 0.1f), bar), 5 - 0.2f, kTol);
    // Crossed bars, parallel bars, crossing bars.
    EXPECT_NEAR(separation(bar, {{0, 0.7f, -1}, {0, 0.7f, 1}, 0.1f}), 0.5f, kTol);
    EXPECT_NEAR(separation(bar, {{-1, 0.4f, 0}, {1, 0.4f, 0}, 0.1f}), 0.2f, kTol);
    EXPECT_NEAR(separation(bar, {{0, -1, 0}, {0, 1, 0}, 0.1f}), -0.2f, kTol);
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
        EXPECT_GT(gap, -2 * kTol) << "round " << round << ": too late";
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
