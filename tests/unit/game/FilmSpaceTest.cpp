// Animals in the space of a film: made walls, a tunnel, a wall that comes nearer, a pillar.
#include "Fixture.h"
#include "game/rules/Intent.h"

namespace shoal::game {
namespace {

// Returns the distance to a wall ahead, 1.6 m from the eyes.
float toWall_m(glm::vec3 dir, double = 0) { return dir.z < -0.05f ? 1.6f / -dir.z : FilmSpace::kFar_m; }

// Returns the distance to a pillar of 0.3 m ahead, whose middle is 1.5 m away.
float toPillar_m(glm::vec3 dir, double = 0) {
    const glm::vec2 flat(dir.x, dir.z), centre(0, -1.5f);
    const float level = glm::length(flat);
    if (level < 1e-3f) return FilmSpace::kFar_m;
    const float along = glm::dot(flat / level, centre);
    const float squared = glm::dot(centre, centre) - along * along;
    if (along < 0 || squared > 0.09f) return FilmSpace::kFar_m;
    return (along - std::sqrt(0.09f - squared)) / level;
}

std::vector<glm::vec3> directions() {
    Random random(3, 1);
    std::vector<glm::vec3> all = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
    while (all.size() < 3000) {
        const float x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
        const glm::vec3 dir(x, y, z);
        if (glm::length(dir) > 0.1f && glm::length(dir) < 1) all.push_back(glm::normalize(dir));
    }
    return all;
}

TEST(FilmSpace, CellsAreWhereTheirDirectionsAre) {
    for (int cell = 0; cell < FilmSpace::kCells; ++cell)
        EXPECT_EQ(FilmSpace::cellOf(FilmSpace::directionOf(cell)), cell);
}

TEST(FilmSpace, LinearFunctionsOfDirectionComeBackOverAllEdges) {
    const auto distance = [](glm::vec3 dir) { return 3 + dir.x - 0.5f * dir.y + 0.7f * dir.z; };
    const auto space = madeSpace(1, 1, [&](glm::vec3 dir, double) { return distance(dir); });
    for (const glm::vec3 dir : directions()) // two thirds of a cell's 0.09 rad times the slope of 1.3
        EXPECT_NEAR(space->surface_m(space->at(0), dir), distance(dir), 0.08f);
}

TEST(FilmSpace, TimeIsLinearAndRepeats) {
    const auto space =
        madeSpace(4, 4, [](glm::vec3, double time_s) { return 1 + static_cast<float>(time_s); });
    const auto at = [&](double time_s) { return space->surface_m(space->at(time_s), {0.3f, 0.2f, 0.9f}); };
    EXPECT_NEAR(at(0), 1, 1e-3);
    EXPECT_NEAR(at(1.5), 2.5, 1e-3);
    EXPECT_NEAR(at(3.5), 2.5, 1e-3); // half way from the last step to the first
    EXPECT_NEAR(at(9.5), at(1.5), 1e-5);
}

TEST(FilmSpace, RoomIsInFrontOfTheSurfaceAndNarrowsSlowly) {
    const auto wall = madeSpace(1, 1, toWall_m);
    const auto here = wall->at(0);
    for (const glm::vec3 dir : directions()) {
        EXPECT_LE(wall->room_m(here, dir), toWall_m(dir) + 0.01f);
        const glm::vec3 beside = glm::normalize(dir + 0.02f * glm::cross(dir, glm::vec3(0.3f, 0.5f, 0.8f)));
        // 2.5 m/rad along each way of the grid, so at most the root of two times that between them; and twice
        // a cell's skew at the octahedron's edges.
        EXPECT_LE(std::fabs(wall->room_m(here, dir) - wall->room_m(here, beside)),
                  2 * 1.42f * 2.5f * glm::distance(dir, beside) + 0.002f);
    }
    // Straight ahead a wall is as far as it is, less what the neighbours of a cell are nearer: nothing.
    EXPECT_NEAR(wall->room_m(here, {0, 0, -1}), 1.6f, 0.01f);

    // A wall that jumps from 5 m to 1 m is foreseen: at most 0.6 m/s.
    const auto jump = madeSpace(20, 80, [](glm::vec3, double time_s) { return time_s < 10 ? 5.0f : 1.0f; });
    for (int i = 0; i < 200; ++i) {
        const float now = jump->room_m(jump->at(0.1 * i), {1, 0, 0});
        EXPECT_NEAR(now, jump->room_m(jump->at(0.1 * (i + 1)), {1, 0, 0}), 0.061f);
        EXPECT_LE(now, jump->surface_m(jump->at(0.1 * i), {1, 0, 0}) + 1e-3f);
    }
}

struct Kept {
    float deepest_m = 0; // greatest depth of a fish's body behind the surface
    float sharkDeepest_m = 0;
    float longestStep_m = 0;   // longest way of a free animal in a tick
    float nearestEyes_m = 100; // least distance of a fish's middle from the eyes
};

// Runs a dive without hands for a minute. distance_m returns the distance of the true surface.
template <class Distance>
Kept watch(std::shared_ptr<const FilmSpace> space, double length_s, const Distance& distance_m, uint64_t seed,
           bool withShark = true) {
    DiveFile file = withShark ? cove().dive : calmCove();
    file.space = space;
    OpenDive dive(cove().species, file, seed);
    Kept kept;
    std::vector<glm::vec3> before;
    for (int tick = 0; tick < 60 * sim::kTickRate_Hz; ++tick) {
        before.clear();
        for (const Fish& f : dive.fish) before.push_back(f.position);
        const glm::vec3 sharkBefore = dive.shark.position;
        dive.events.clear();
        dive.step();
        const double time_s = std::fmod((tick + 1) / 120.0, length_s);
        const auto look = [&](const Swimmer& s, int species, glm::vec3 was, float& deepest_m) {
            const physics::Capsule body = capsuleOf(s, cove().species[species]);
            for (int i = 0; i <= 4; ++i) {
                const glm::vec3 at = body.a + (body.b - body.a) * (0.25f * static_cast<float>(i));
                const float length = glm::length(at);
                deepest_m = std::max(deepest_m, length + body.radius - distance_m(at / length, time_s));
            }
            kept.longestStep_m = std::max(kept.longestStep_m, glm::distance(s.position, was));
        };
        for (size_t i = 0; i < dive.fish.size(); ++i) {
            look(dive.fish[i], dive.fish[i].species, before[i], kept.deepest_m);
            kept.nearestEyes_m = std::min(kept.nearestEyes_m, glm::length(dive.fish[i].position));
        }
        if (dive.shark.present) look(dive.shark, dive.shark.species, sharkBefore, kept.sharkDeepest_m);
    }
    return kept;
}

constexpr float kDeepest_m = 0.02f; // a body deeper than this is behind the surface
// The shark's room narrows as fast as it can follow, and no slower: where it turns beside a wall, or passes a
// pillar, its nose or tail enters it for a moment. Measured: 0.05 m in the tunnel, 0.2 m at the pillar.
constexpr float kSharkDeepest_m = 0.06f, kSharkDeepestAtPillar_m = 0.25f;
constexpr float kLongestStep_m = (3 + 2) * kDt + 1e-4f; // the fastest swimming and the fastest giving way

void expectKept(const Kept& kept, const std::string& name) {
    EXPECT_LT(kept.deepest_m, kDeepest_m) << name;
    EXPECT_LT(kept.sharkDeepest_m, kSharkDeepest_m) << name;
    EXPECT_LT(kept.longestStep_m, kLongestStep_m) << name;
    EXPECT_GT(kept.nearestEyes_m, 0.35f) << name; // the room around the eyes
}

TEST(FilmSpace, AnimalsKeepInFrontOfAWallAndInATunnel) {
    EXPECT_GT(watch(nullptr, 1, toWall_m, 5).sharkDeepest_m, 0.3f); // so there is something to keep
    // Along Z, of a radius of 2 m.
    const auto toTunnel = [](glm::vec3 dir, double) {
        return 2 / std::max(glm::length(glm::vec2(dir)), 1e-3f);
    };
    for (uint64_t seed : {5, 6}) {
        expectKept(watch(madeSpace(1, 1, toWall_m), 1, toWall_m, seed), "wall");
        expectKept(watch(madeSpace(1, 1, toTunnel), 1, toTunnel, seed), "tunnel");
    }
}

TEST(FilmSpace, AWallThatComesNearerPushesThemAsideWithoutAJump) {
    // A shark that looks at the eyes from 0.55 m off takes up to 2.49 m: half of 0.92 of its length of 2.2 m,
    // half its core and its radius beyond that. Where there is less, the room around the eyes comes first.
    for (const bool shark : {true, false}) {
        // A sphere around the viewer that shrinks by 4 m in 8 s, and grows again.
        const auto surface_m = [&](glm::vec3, double time_s) {
            const double share = time_s < 8 ? time_s / 8 : 2 - time_s / 8;
            return (shark ? 2.5f : 1.4f) + 4 * (1 - static_cast<float>(share));
        };
        expectKept(watch(madeSpace(16, 64, surface_m), 16, surface_m, 5, shark), shark ? "shark" : "fish");
    }
}

TEST(FilmSpace, APillarIsPassedAndNobodyStaysAtIt) {
    const auto space = madeSpace(1, 1, toPillar_m);
    EXPECT_LT(watch(space, 1, toPillar_m, 5, false).deepest_m, kDeepest_m);
    const Kept kept = watch(space, 1, toPillar_m, 5);
    EXPECT_LT(kept.sharkDeepest_m, kSharkDeepestAtPillar_m);
    EXPECT_LT(kept.deepest_m,
              0.4f); // fish that flee from the shark round the pillar: 0.34 m in one of eight dives
    EXPECT_LT(kept.longestStep_m, kLongestStep_m);
}

TEST(FilmSpace, ShoalsPartAtAPillarAndJoinAgain) {
    constexpr float kParted = 3.5f; // shoals in open water stay below 2.7
    int parted = 0;
    SpeciesTable alike = cove().species; // shoals of one size part in nine dives of forty, others in three
    for (Species& kind : alike) kind.varies = 0;
    for (uint64_t seed = 5; seed < 17; ++seed) {
        DiveFile file = calmCove();
        file.space = madeSpace(1, 1, toPillar_m);
        OpenDive dive(alike, file, seed);
        std::vector<float> apart_s(file.schools.size());
        for (int tick = 0; tick < 140 * sim::kTickRate_Hz; ++tick) {
            dive.step();
            if (tick < 20 * sim::kTickRate_Hz) continue; // they gather first
            for (size_t i = 0; i < file.schools.size(); ++i) {
                if (cove().species[file.schools[i].species].company != Company::Shoal) continue;
                const bool apart = spreadOf(dive, static_cast<int>(i)) > kParted;
                parted += apart && apart_s[i] == 0;
                apart_s[i] = apart ? apart_s[i] + kDt : 0;
                ASSERT_LT(apart_s[i], 8) << "seed " << seed << " school " << i;
            }
        }
    }
    EXPECT_GT(parted, 2);
}

TEST(FilmSpace, AHiddenFishIsNeitherShownNorHelpedToNorTaken) {
    // The whole film is 0.65 m away; the fish is put back behind it in every tick.
    const auto near = madeSpace(1, 1, [](glm::vec3, double) { return 0.65f; });
    const glm::vec3 behind(0, -0.1f, -0.8f);
    for (const bool hidden : {false, true}) {
        OneFish one({.rules = {Assist::Strong},
                     .change = [&](DiveFile& file) { file.space = hidden ? near : nullptr; }});
        for (int i = 0; i < 60; ++i) {
            one.rest(behind);
            one.hand(behind, i < 30 ? 0.0f : std::min(1.0f, static_cast<float>(i - 30) / 15));
        }
        Snapshot now = one.shown();
        EXPECT_EQ(one.world.hands[1].intent.fish >= 0 || one.fish().heldBy >= 0, !hidden);
        EXPECT_EQ(one.fish().catchable > 0 || one.fish().heldBy >= 0, !hidden);
        EXPECT_EQ(one.fish().heldBy, hidden ? -1 : 1);
        EXPECT_EQ(now.creatures[0].hidden, hidden);
        if (!hidden) continue;
        int target = -1;
        const auto reach_m = [&](glm::vec3 ray) { return reachHelp(now, cove().species, ray, 0.5f, target); };
        const float distance_m = glm::length(now.creatures[0].position);
        const glm::vec3 ray = now.creatures[0].position / distance_m;
        EXPECT_FALSE(reach_m(ray));
        now.creatures[0].hidden = false;
        now.creatures[0].velocity = glm::vec3(0);
        EXPECT_NEAR(tests::valueOf(reach_m(ray)), distance_m, 1e-5f);
        EXPECT_FALSE(reach_m({-1, 0, 0}));
    }
}

TEST(FilmSpace, NothingHidesWhatIsNearerThanHandsReachAndAHeadBesideTheCameraLooksPast) {
    const auto pillar = madeSpace(1, 1, toPillar_m);
    const FilmMoment now(pillar.get(), 0);
    const glm::vec3 eyes(0), behind(0, 0, -2.2f);
    EXPECT_TRUE(now.hides(eyes, behind));
    EXPECT_FALSE(now.hides(eyes, {0, 0, -1.1f}));
    EXPECT_FALSE(now.hides(eyes, {1.2f, 0, -2.2f}));
    const auto close = madeSpace(1, 1, [](glm::vec3, double) { return 0.4f; });
    EXPECT_FALSE(FilmMoment(close.get(), 0).hides(eyes, {0, 0, -0.59f}));
    EXPECT_TRUE(FilmMoment(close.get(), 0).hides(eyes, {0, 0, -0.7f}));
    EXPECT_FALSE(FilmMoment().hides(eyes, behind));
}

TEST(FilmSpace, AReplayIsPlayedInItsOwnSpaceAlone) {
    DiveFile file = cove().dive;
    const auto headerIn = [&](std::shared_ptr<const FilmSpace> space) {
        file.space = std::move(space);
        return recordingHeader(Dive(cove().species, file, 3));
    };
    const auto wall = madeSpace(1, 1, toWall_m), pillar = madeSpace(1, 1, toPillar_m);
    const auto without = headerIn(nullptr), with = headerIn(wall);
    EXPECT_FALSE(needsFilmSpace(without));
    EXPECT_TRUE(needsFilmSpace(with));
    EXPECT_TRUE(checkFilmSpace(without, nullptr));
    EXPECT_TRUE(checkFilmSpace(with, wall.get()));
    EXPECT_TRUE(checkFilmSpace(with, madeSpace(1, 1, toWall_m).get())); // made anew
    for (const Status& refused : {checkFilmSpace(with, nullptr), checkFilmSpace(with, pillar.get())}) {
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().reason.find(with.settings.at("film_space")), std::string::npos);
    }
    EXPECT_FALSE(checkFilmSpace(without, wall.get()));
    EXPECT_TRUE(rulesOf(with));
}

} // namespace
} // namespace shoal::game
