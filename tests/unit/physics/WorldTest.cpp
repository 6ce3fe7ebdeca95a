#include "engine/core/Random.h"
#include "tests/LevelFloor.h"
#include "tests/Test.h"

#include <LinearMath/btAlignedAllocator.h>

namespace shoal::physics {
namespace {

constexpr float kDt = 1.0f / 120;
constexpr float kVolume_m3 = 4.0f / 3 * 3.14159265f * 0.03f * 0.03f * 0.03f; // of the spheres below

LooseBody sphere(uint32_t id, glm::vec3 at, glm::vec3 velocity = glm::vec3(0)) {
    return {.id = id, .radius = 0.03f, .half = 0, .position = at, .velocity = velocity};
}

Body still(uint32_t id, glm::vec3 at, float half = 0.1f, float radius = 0.05f) {
    const Capsule capsule{at - glm::vec3(0, 0, half), at + glm::vec3(0, 0, half), radius};
    return {id, capsule, capsule, glm::vec3(0)};
}

// Weight in water over drag: sqrt(2 V g (density - water) / (water drag area)), with the area of a sphere.
TEST(World, AStoneSinksAtItsTerminalVelocity) {
    LooseBody stone = sphere(0, {0, 0, 0});
    World world;
    std::vector<Knock> knocks;
    for (int i = 0; i < 240; ++i) world.move({&stone, 1}, {}, tests::levelFloor(-1000), kDt, knocks);
    const float area = 3.14159265f * 0.03f * 0.03f;
    const float terminal =
        std::sqrt(2 * kVolume_m3 * 9.81f * (2600 - kWater_kgpm3) / (kWater_kgpm3 * 0.5f * area));
    EXPECT_NEAR(stone.velocity.y, -terminal, 1e-3f * terminal);
    EXPECT_EQ(stone.velocity.x, 0);
}

// Half the displaced water moves along: 0.5 added to a sphere's mass.
TEST(World, BuoyancyStartsWithAddedMass) {
    LooseBody light = sphere(0, {0, 0, 0});
    light.density_kgpm3 = 500;
    const float expected = 9.81f * (kWater_kgpm3 - 500) / (500 + 0.5f * kWater_kgpm3);
    EXPECT_NEAR(inWater(light, 1e-4f).y / 1e-4f, expected, 1e-3f * expected);
}

TEST(World, NoThrowTunnelsThroughTheFloorAndAllComeToRest) {
    for (const float speed : {0.1f, 1.0f, 5.0f, 15.0f}) {
        LooseBody stone = sphere(0, {0, 0.2f, 0}, {0.3f * speed, -speed, 0});
        World world;
        const Ground floor = tests::levelFloor(0, 0.6f);
        std::vector<Knock> knocks;
        float hardest = 0;
        for (int i = 0; i < 600; ++i) {
            world.move({&stone, 1}, {}, floor, kDt, knocks);
            for (const Knock& knock : knocks) {
                EXPECT_EQ(knock.other, kGroundId);
                hardest = std::max(hardest, knock.closing_mps);
            }
            ASSERT_GT(stone.position.y, 0.0149f) << speed; // a step is at most half a radius
        }
        EXPECT_GT(hardest, 0.09f);
        EXPECT_LE(hardest, speed + 1.9f); // the terminal velocity more at most
        EXPECT_NEAR(stone.position.y, 0.03f, 0.003f);
        EXPECT_LT(glm::length(stone.velocity), 0.05f) << speed; // at most it rolls slowly
    }
}

TEST(World, AThrownStoneStrikesABodyAtAnySpeed) {
    for (const float speed : {1.0f, 5.0f, 15.0f})
        for (const float aside : {0.0f, 0.03f, 0.06f}) {
            LooseBody stone = sphere(1, {-0.4f, aside, 0}, {speed, 0, 0});
            stone.density_kgpm3 = kWater_kgpm3; // it flies straight...
            stone.drag = 0;                     // ...and on
            const Body fish = still(0, {0, 0, 0});
            World world;
            std::vector<Knock> knocks;
            bool struck = false;
            for (int i = 0; i < 240 && !struck; ++i) {
                world.move({&stone, 1}, {&fish, 1}, tests::levelFloor(-9), kDt, knocks);
                struck = !knocks.empty();
                if (struck) {
                    EXPECT_EQ(std::pair(knocks[0].loose, knocks[0].other), std::pair(1u, 0u));
                }
            }
            EXPECT_TRUE(struck) << speed << ' ' << aside;
            EXPECT_LT(stone.position.x, 0);
        }
}

// Two equal spheres in line, elastic to the product of their coefficients: momentum stays, energy falls.
TEST(World, BodiesShareMomentum) {
    LooseBody stones[] = {sphere(0, {0, 0, 0}, {1, 0, 0}), sphere(1, {0.0595f, 0, 0})};
    for (LooseBody& stone : stones) {
        stone.density_kgpm3 = kWater_kgpm3;
        stone.drag = 0;
        stone.bounce = 0.5f;
    }
    World world;
    std::vector<Knock> knocks;
    world.move(stones, {}, tests::levelFloor(-9), kDt, knocks);
    EXPECT_NEAR(stones[0].velocity.x + stones[1].velocity.x, 1, 1e-4f);
    EXPECT_NEAR(stones[1].velocity.x - stones[0].velocity.x, 0.25f, 1e-3f);
    ASSERT_EQ(knocks.size(), 1u);
    EXPECT_NEAR(knocks[0].closing_mps, 1, 1e-4f);
}

// Twelve bodies fall among one another, a swimming fish, and onto a floor.
struct Fall {
    std::vector<LooseBody> bodies;
    std::vector<Knock> knocks;
    Fall() {
        Random random(7, 1);
        for (uint32_t i = 0; i < 12; ++i) {
            LooseBody& b = bodies.emplace_back(
                sphere(i, {random.between(-0.1f, 0.1f), 0.1f + 0.08f * static_cast<float>(i),
                           random.between(-0.1f, 0.1f)}));
            b.half = 0.01f * static_cast<float>(i % 4);
            b.spin = {random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)};
        }
    }
    void step(World& world, int tick) {
        const float x = 0.3f * static_cast<float>(tick % 240) / 240;
        Body fish = still(20, {x, 0.1f, 0});
        fish.velocity = {0.15f, 0, 0};
        const Ground floor = tests::levelFloor(0, 0.6f);
        world.move(bodies, {&fish, 1}, floor, kDt, knocks);
    }
    bool operator==(const Fall& other) const {
        const auto same = [](const LooseBody& a, const LooseBody& b) {
            return a.position == b.position && a.velocity == b.velocity && a.spin == b.spin &&
                   a.worldFromBody == b.worldFromBody;
        };
        return std::ranges::equal(bodies, other.bodies, same);
    }
};

// The other world has made objects in another order and of another size, and comes in while bodies fall.
TEST(World, KeepsNothingFromTickToTick) {
    for (const int from : {30, 60, 120, 500}) {
        Fall one;
        World old, fresh;
        Fall reversed;
        std::ranges::reverse(reversed.bodies);
        for (LooseBody& b : reversed.bodies) b.radius *= 0.2f;
        reversed.step(fresh, 0);
        for (int tick = 0; tick < from; ++tick) one.step(old, tick);
        Fall other = one;
        for (int tick = from; tick < 1000; ++tick) {
            one.step(old, tick);
            other.step(fresh, tick);
            ASSERT_EQ(one, other) << tick;
        }
    }
}

TEST(World, ForgetsWhatANumberThatIsNoneWouldDo) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    LooseBody stone = sphere(0, {0, 1, 0});
    const Body fish = still(3, {none, 0, 0});
    const Mover bone{{{none, 0, 0}, {0, 0, 0}, 0.01f}, {{0, 0, 0}, {0, 0, 0}, 0.01f}};
    World world;
    std::vector<Knock> knocks;
    std::vector<Contact> contacts;
    world.touch({&fish, 1}, {&bone, 1}, kDt, {}, contacts);
    EXPECT_TRUE(contacts.empty());
    Body swift = still(4, {0, 1, 0});
    swift.velocity.x = none;
    world.move({&stone, 1}, {&swift, 1}, tests::levelFloor(0), kDt, knocks);
    EXPECT_TRUE(std::isfinite(stone.velocity.x));
    world.move({&stone, 1}, {&fish, 1}, tests::levelFloor(0), kDt, knocks);
    EXPECT_TRUE(std::isfinite(stone.position.y));
}

int allocations = 0;

TEST(World, AllocatesNothingOnceItHasGrown) {
    btAlignedAllocSetCustom([](size_t bytes) { return ++allocations, std::malloc(bytes); }, std::free);
    {
        World world;
        Fall fall;
        for (int tick = 0; tick < 480; ++tick) fall.step(world, tick);
        allocations = 0;

        for (int tick = 480; tick < 960; ++tick) fall.step(world, tick);
        EXPECT_EQ(allocations, 0);
    }
    btAlignedAllocSetCustom(nullptr, nullptr);
}

} // namespace
} // namespace shoal::physics
