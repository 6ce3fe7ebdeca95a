// A giant passes once, whatever the player does.
#include "Fixture.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

constexpr glm::vec3 kFrom{-20, 5, -6}, kTo{20, 5, -6};
constexpr float kAt_s = 2, kSpeed_mps = 2;

Dive diveWithWhale() {
    DiveFiles files = test::cove();
    Species whale{.name = "whale", .giant = true, .length_m = 12, .cruise_mps = kSpeed_mps, .stride = 1};
    files.species.push_back(whale);
    files.dive.encounter = {static_cast<int>(files.species.size()) - 1, kAt_s, kFrom, kTo};
    return {files.species, files.dive, 1};
}

const CreatureView* whaleOf(const Dive& dive, const Snapshot& shown) {
    for (const CreatureView& creature : shown.creatures)
        if (dive.species()[static_cast<size_t>(creature.species)].giant) return &creature;
    return nullptr;
}

TEST(Encounter, PassesOnceFromOnePlaceToTheOther) {
    Dive dive = diveWithWhale();
    const size_t whale = dive.species().size() - 1;
    Snapshot shown;
    int events = 0;
    for (int tick = 1; tick <= 30 * 120; ++tick) {
        Events happened;
        dive.step({}, happened);
        dive.snapshot(shown);
        const float passed_s = static_cast<float>(tick) * kDt - kAt_s;
        const float passed_m = passed_s * kSpeed_mps;
        const CreatureView* seen = whaleOf(dive, shown);
        if (passed_s < -kDt || passed_m > glm::distance(kFrom, kTo) + 0.1f) {
            EXPECT_FALSE(seen) << passed_s;
        } else if (passed_s > kDt && passed_m < glm::distance(kFrom, kTo) - 0.1f) {
            ASSERT_TRUE(seen) << passed_s;
            EXPECT_EQ(&shown.creatures[seen->id], seen) << "its id is its place";
            // Two ticks' way: the one in which it sets out, and rounding over thousands.
            EXPECT_LT(glm::distance(seen->position, kFrom + glm::vec3(passed_m, 0, 0)), 2 * kDt * kSpeed_mps);
            EXPECT_LT(glm::distance(seen->worldFromBody * glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)), 1e-4f);
            EXPECT_NEAR(seen->shape.beats, passed_m / 12, 0.01f) << "a stride of its length";
        }
        for (const Event& event : happened) {
            if (event.kind != EventKind::Encounter) continue;
            ++events;
            EXPECT_GT(glm::dot(glm::normalize(*event.position), glm::normalize(kFrom)), 0.999f)
                << "heard from where it comes";
        }
    }
    EXPECT_EQ(events, 1);
    EXPECT_TRUE(shown.tally[whale].touched) << "met";
    EXPECT_FALSE(whaleOf(dive, shown));
}

TEST(Encounter, ItsSpeciesIsShownAndNoOneElseMissed) {
    const DiveFiles& cove = test::cove();
    DiveFile empty;
    EXPECT_THAT(speciesShown(cove.species, empty), testing::Each(false));
    empty.encounter.species = 0;
    empty.shark.species = 2;
    empty.schools.push_back({.species = 1});
    const auto shown = speciesShown(cove.species, empty);
    EXPECT_EQ(std::vector(shown.begin(), shown.begin() + 3), std::vector({true, true, true}));
    EXPECT_EQ(std::ranges::count(shown, true), 3);
}

} // namespace
} // namespace shoal::game
