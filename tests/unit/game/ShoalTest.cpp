// Shoals, pairs and solitary fish, distinguished by quantities that biologists measure in a
// tank.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::cove;

// Order of one school at one moment. Lengths in body lengths.
struct Order {
    float polarisation = 0; // length of the mean heading: 1 all alike, 0 all ways (Couzin et al. 2002)
    float nearest = 1e9f;   // neighbour, centre to centre, of any fish
    float meanNearest = 0;  // mean over all fish
    float farthest = 0;     // greatest distance from the school's middle
};

Order orderOf(const test::OpenDive& world, int school) {
    Order order;
    glm::vec3 heading(0);
    int count = 0;
    float length_m = 1;
    for (const Fish& a : world.fish) {
        if (a.school != school) continue;
        length_m = world.species()[a.species].length_m;
        heading += a.forward;
        ++count;
        float nearest = 1e9f;
        for (const Fish& b : world.fish)
            if (&a != &b && b.school == school)
                nearest = std::min(nearest, glm::distance(a.position, b.position) / length_m);
        order.nearest = std::min(order.nearest, nearest);
        order.meanNearest += nearest;
    }
    const auto n = static_cast<float>(count);
    order.polarisation = glm::length(heading) / n;
    order.meanNearest /= n;
    order.farthest = test::spreadOf(world, school);
    return order;
}

class Companions : public testing::TestWithParam<uint64_t> {};

TEST_P(Companions, ShoalsAlignAndPairsStayTogether) {
    test::OpenDive world(cove().species, test::calmCove(), GetParam());
    world.run(20);
    const auto& schools = world.file().schools;
    std::vector<double> polarisation(schools.size(), 0), nearest(schools.size(), 0);
    int samples = 0, shoals = 0, pairs = 0, nearPairs = 0;
    for (; samples < 200; ++samples) {
        world.run(0.2f);
        for (size_t s = 0; s < schools.size(); ++s) {
            const Order order = orderOf(world, static_cast<int>(s));
            polarisation[s] += order.polarisation;
            nearest[s] += order.meanNearest;
            if (world.species()[schools[s].species].company != Company::Shoal) continue;
            EXPECT_GT(order.nearest, 0.5f);
            // One that turns as a whole is out of order for a moment, but together.
            EXPECT_LT(order.farthest, 6);
        }
        for (const Fish& fish : world.fish) {
            const Species& kind = world.species()[fish.species];
            const Fish& partner = world.fish[static_cast<size_t>(fish.route.leader)];
            if (kind.company != Company::Pair || &partner == &fish) continue;
            EXPECT_EQ(partner.species, fish.species);
            ++pairs;
            nearPairs += glm::distance(fish.position, partner.position) < 3 * kind.length_m;
        }
    }
    EXPECT_GT(pairs, 0);
    EXPECT_GT(nearPairs, 0.9 * pairs);
    for (size_t s = 0; s < schools.size(); ++s) {
        const Species& kind = world.species()[schools[s].species];
        const double order = polarisation[s] / samples, apart = nearest[s] / samples;
        if (kind.company == Company::Shoal) {
            ++shoals;
            EXPECT_GT(order, 0.9) << kind.name;
            EXPECT_LT(apart, 1.5 * kind.spacing) << kind.name;
        } else if (schools[s].count > 2) {
            EXPECT_LT(order, 0.9) << kind.name; // two pairs that meet agree for a while
        }
        if (kind.company == Company::Alone) {
            EXPECT_GT(apart, 2.0) << kind.name;
        }
    }
    EXPECT_GE(shoals, 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Companions, testing::Values(1, 2, 3));

TEST(Shoal, ScatteredByAFrightComesTogetherAgain) {
    test::OpenDive world(cove().species, test::calmCove(), 4);
    world.run(5);
    Events events;
    int school = 0;
    for (size_t i = 0; i < world.fish.size(); ++i) {
        const Fish& fish = world.fish[i];
        if (world.species()[fish.species].company != Company::Shoal) continue;
        school = fish.school;
        // Each is frightened from another side, so that they burst apart.
        const glm::vec3 from(i % 3 ? 0.2f : -0.2f, 0, i % 2 ? 0.2f : -0.2f);
        world.startle(static_cast<int>(i), fish.position + from, events);
    }
    float widest = 0;
    for (int i = 0; i < 20; ++i) {
        world.run(0.1f);
        widest = std::max(widest, orderOf(world, school).farthest);
    }
    world.run(18);
    EXPECT_GT(widest, 4);
    EXPECT_LT(orderOf(world, school).farthest, 4);
    EXPECT_GT(orderOf(world, school).polarisation, 0.8f);
}

// A dive as full as it may get: forty fish of seven kinds, with two shoals and a ray.
TEST(Shoal, SevenKindsAndFortyFishKeepApart) {
    const SpeciesTable& species = cove().species;
    DiveFile file = cove().dive;
    int missing = 40;
    for (const School& school : file.schools) missing -= school.count;
    for (size_t s = 0; missing > 0; s = (s + 1) % file.schools.size())
        if (species[file.schools[s].species].length_m < 0.5f) ++file.schools[s].count, --missing;
    EXPECT_EQ(file.schools.size(), 7u);
    test::OpenDive world(species, file, 8);
    EXPECT_EQ(world.fish.size(), 40u);
    int touching = 0, pairs = 0;
    for (int i = 0; i < 600; ++i) {
        world.run(0.1f);
        for (size_t a = 0; a < world.fish.size(); ++a)
            for (size_t b = 0; b < a; ++b) {
                const Fish &first = world.fish[a], &second = world.fish[b];
                touching += physics::separation(capsuleOf(first, species[first.species]),
                                                capsuleOf(second, species[second.species])) < 0;
                ++pairs;
            }
    }
    EXPECT_LT(touching, pairs / 5000);
}

} // namespace
} // namespace shoal::game
