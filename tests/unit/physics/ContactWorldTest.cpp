#include "engine/physics/ContactWorld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::physics {
namespace {

constexpr float kDt = 1.0f / 120;

// Single precision on lengths below 1 m, a handful of operations.
constexpr float kTol = 1e-5f;

Mover still(Capsule c, int tag = 0) { return {c, c, 0, tag}; }

Mover moving(glm::vec3 from, glm::vec3 to, float radius) {
    return {{from, from, radius}, {to, to, radius}, 0, 0};
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

TEST(ContactWorld, TellsDepthNormalAndPointOfSphereAgainstCapsule) {
    ContactWorld world;
    const Body fish{5, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.03f, 0.05f};
    // A ball of 1 cm, 3.5 cm left of the axis: 5 mm deep.
    const Mover ball = still({{-0.035f, 0, 0.02f}, {-0.035f, 0, 0.02f}, 0.01f}, 7);
    std::vector<Contact> contacts;
    world.collide({&fish, 1}, {&ball, 1}, kDt, contacts);
    ASSERT_EQ(contacts.size(), 1u);
    const Contact& c = contacts[0];
    EXPECT_EQ(c.body, 5u);
    EXPECT_EQ(c.tag, 7);
    EXPECT_NEAR(c.depth, 0.005f, kTol);
    EXPECT_NEAR(glm::distance(c.normal, glm::vec3(1, 0, 0)), 0, kTol);
    EXPECT_NEAR(glm::distance(c.point, glm::vec3(-0.03f, 0, 0.02f)), 0, kTol);
    EXPECT_EQ(c.closingSpeed, 0);
}

TEST(ContactWorld, ClosingSpeedIsRelative) {
    ContactWorld world;
    const Body fish{0, {0, 0, 0}, {0, 0, 1}, {-0.5f, 0, 0}, 0.03f, 0.05f};
    const Mover ball = moving({-0.06f, 0, 0}, {-0.03f, 0, 0}, 0.01f); // 3.6 m/s towards it
    std::vector<Contact> contacts;
    world.collide({&fish, 1}, {&ball, 1}, kDt, contacts);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].closingSpeed, 4.1f, 1e-3f);
    // They meet when the gap of 40 mm less 20 mm... is used up: from -60 + 36 t mm against 0.5 m/s the other
    // way.
    EXPECT_GT(contacts[0].time, 0.3f);
    EXPECT_LT(contacts[0].time, 0.9f);
}

TEST(ContactWorld, NothingTunnelsAtAnySpeedBelowATeleport) {
    ContactWorld world;
    std::vector<Contact> contacts;
    const Body fish{0, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.02f, 0.03f};
    for (float speed : {1.0f, 5.0f, 20.0f, 60.0f, 150.0f})
        for (float offset : {0.1f, 0.35f, 0.5f, 0.77f, 0.9f}) // where in the tick it passes
            for (float aside : {0.0f, 0.012f}) {
                const float way = speed * kDt;
                const Mover tip =
                    moving({-way * offset - 0.0f, aside, 0}, {way * (1 - offset), aside, 0}, 0.006f);
                world.collide({&fish, 1}, {&tip, 1}, kDt, contacts);
                EXPECT_EQ(contacts.size(), 1u) << speed << " m/s, offset " << offset << ", aside " << aside;
            }
}

TEST(ContactWorld, ATeleportTouchesNothingOnItsWay) {
    ContactWorld world;
    std::vector<Contact> contacts;
    const Body fish{0, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.02f, 0.03f};
    const Mover tip = moving({-1, 0, 0}, {1, 0, 0}, 0.006f);
    world.collide({&fish, 1}, {&tip, 1}, kDt, contacts);
    EXPECT_TRUE(contacts.empty());
}

TEST(ContactWorld, ResultIsSortedAndIndependentOfOrderAndHistory) {
    std::vector<Body> bodies;
    std::vector<Mover> movers;
    for (uint32_t i = 0; i < 6; ++i)
        bodies.push_back({i, {0.03f * static_cast<float>(i), 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.03f, 0.04f});
    for (int i = 0; i < 6; ++i) {
        Mover m = moving({-0.1f, 0.01f * static_cast<float>(i), 0}, {0.15f, 0.01f, 0}, 0.008f);
        m.group = i % 2;
        m.tag = i;
        movers.push_back(m);
    }
    const auto key = [](const Contact& c) { return std::tuple(c.body, c.group, c.tag); };
    const auto same = [&](const Contact& a, const Contact& b) {
        return key(a) == key(b) && a.point == b.point && a.normal == b.normal && a.depth == b.depth;
    };
    ContactWorld first, second;
    std::vector<Contact> forwards, backwards;
    first.collide(bodies, movers, kDt, forwards);
    ASSERT_GT(forwards.size(), 10u);
    for (size_t i = 1; i < forwards.size(); ++i) EXPECT_LT(key(forwards[i - 1]), key(forwards[i]));
    std::reverse(bodies.begin(), bodies.end());
    std::reverse(movers.begin(), movers.end());
    for (int round = 0; round < 3; ++round) second.collide(bodies, movers, kDt, backwards);
    ASSERT_EQ(forwards.size(), backwards.size());
    for (size_t i = 0; i < forwards.size(); ++i) EXPECT_TRUE(same(forwards[i], backwards[i])) << i;
}

} // namespace
} // namespace shoal::physics
